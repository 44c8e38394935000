#include "ui_cli/view/server.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "ui_cli/view/connections.hpp"
#include "ui_cli/view/run_source.hpp"
#include "ui_cli/view/static_files.hpp"

namespace mrroc::view {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using httplib::Request;
using httplib::Response;

constexpr auto kPeriod = 40ms;    // between two pieces of news for a page
constexpr auto kHeartbeat = 10s;  // without news
constexpr int kPortsTried = 20;

// A page gets its files from here alone.
constexpr const char* kPolicy =
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self'; object-src 'none'; base-uri 'none'; "
    "frame-ancestors 'none'";

void refuse(Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(
      nlohmann::json{{"error", why}}.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace),
      "application/json");
}

/// @return whether the browser was told to go to this host, by a name that only this host has
bool called_by_own_name(const Request& request) {
  std::string host = request.get_header_value("Host");
  if (const auto colon = host.rfind(':'); colon != std::string::npos) host.resize(colon);
  return host == "127.0.0.1" || host == "localhost";
}

httplib::Server::HandlerResponse admit(const Request& request, Response& response) {
  using enum httplib::Server::HandlerResponse;
  if (!called_by_own_name(request)) {
    refuse(response, 403, "call the viewer by its own address, http://127.0.0.1");
    return Handled;
  }
  if (request.method != "GET" && request.method != "HEAD") {
    refuse(response, 405, "the viewer only shows; orders are given with ui_cli");
    return Handled;
  }
  return Unhandled;
}

void serve_static(const StaticFile& file, httplib::Server& http) {
  const auto serve = [&file](const Request&, Response& response) {
    response.set_content(file.content.data(), file.content.size(), std::string(file.type));
  };
  const auto plain = [](std::string_view path) {  // paths are patterns
    std::string pattern;
    for (const char c : path) pattern += c == '.' ? std::string("\\.") : std::string(1, c);
    return pattern;
  };
  http.Get(plain(file.path), serve);
  if (file.path == "/index.html") http.Get("/", serve);
}

}  // namespace

Server::Server(Shown shown, int port) : shown_(std::move(shown)), http_(std::make_unique<TimedServer>()) {
  http_->set_socket_options([](int socket) {  // a port that another viewer has is taken
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  http_->set_tcp_nodelay(true);
  http_->set_payload_max_length(0);  // requests that show something have none
  http_->set_default_headers({{"Content-Security-Policy", kPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cache-Control", "no-store"}});
  http_->set_pre_routing_handler(admit);
  http_->set_error_handler([](const Request& request, Response& response) {
    if (response.body.empty() && response.status >= 400)
      refuse(response, response.status, fmt::format("there is no {}", request.path));
  });
  route();
  const int first = port != 0 ? port : kUsualPort;
  const int last = port != 0 ? port : kUsualPort + kPortsTried - 1;
  for (port_ = first; port_ <= last; ++port_)
    if (http_->bind_to_port("127.0.0.1", port_)) break;
  if (port_ > last)
    throw FaultError(FaultCode::bad_usage, fmt::format("port {} of 127.0.0.1 is taken", first),
                     "give another one with --port N, or none");
  http_->widen_door();
  thread_ = std::thread([this] { http_->listen_after_bind(); });
  while (!http_->is_running()) std::this_thread::sleep_for(1ms);
}

Server::~Server() {
  stop_ = true;
  http_->stop();
  thread_.join();
}

std::string Server::url() const { return fmt::format("http://127.0.0.1:{}/", port_); }

void Server::route() {
  for (const StaticFile& file : static_files()) serve_static(file, *http_);
  http_->Get("/api/scene", [this](const Request&, Response& response) {
    response.set_content(shown_.record.scene(), "application/json");
  });
  http_->Get("/api/stream", [this](const Request&, Response& response) { stream(response); });
  http_->Get(R"(/api/camera/([A-Za-z0-9_-]+)\.bmp)", [this](const Request& request, Response& response) {
    if (const auto picture = shown_.cameras.picture(request.matches[1]))
      response.set_content(*picture, "image/bmp");
    else
      refuse(response, 404, fmt::format("there is no picture of a camera {}", request.matches[1].str()));
  });
  http_->Get("/api/picture/(.+)",
             [this](const Request& request, Response& response) { picture(request, response); });
}

void Server::picture(const Request& request, Response& response) const {
  const std::string wanted = request.matches[1];
  const std::filesystem::path folder = shown_.folder();
  const auto known = folder.empty() ? std::vector<std::string>{} : pictures_of(folder);
  if (std::ranges::find(known, wanted) == known.end())
    return refuse(response, 404, "the run folder has no such picture");
  std::ifstream file(folder / wanted, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (!file) return refuse(response, 404, "the picture cannot be read");
  response.set_content(bytes, "image/png");
}

void Server::stream(Response& response) {
  if (++pages_ > kMostPages) {
    --pages_;
    return refuse(response, 503, "too many pages are open; close one");
  }
  struct Page {
    Record::Cursor cursor;
    Clock::time_point next{};
    Clock::time_point heartbeat{Clock::now() + kHeartbeat};
  };
  const auto send = [](httplib::DataSink& sink, const std::string& text) {
    return sink.is_writable() && sink.write(text.data(), text.size());
  };
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, send, page = std::make_shared<Page>()](std::size_t, httplib::DataSink& sink) {
        std::this_thread::sleep_until(page->next);
        if (stop_) return false;
        const auto now = Clock::now();
        page->next = now + kPeriod;
        std::string news = shown_.record.news(page->cursor);
        if (news.empty() && now < page->heartbeat) return sink.is_writable();
        page->heartbeat = now + kHeartbeat;
        if (news.empty()) return send(sink, ": nothing new\n\n");
        if (page->cursor.change < 0) page->next = now;  // there is more: without a break
        return send(sink, "data: " + news + "\n\n");
      },
      [this](bool) { --pages_; });
}

}  // namespace mrroc::view
