#include "vsp/picture_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string_view>

#include "base/fault.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kLargestFile = 256U << 20U;  // [bytes]
constexpr int kLargestEdge = 8192;                    // [pixel]
constexpr std::size_t kJpegTail = 4096;               // what cameras write behind a picture [bytes]
constexpr double kLeastShare = 0.95;                  // of the pictures that a film promises
constexpr std::array<std::string_view, 8> kEndings{".png", ".jpg",  ".jpeg", ".bmp",
                                                   ".tif", ".tiff", ".pgm",  ".ppm"};

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw FaultError(FaultCode::bad_picture, file.string() + ": " + why);
}

std::string ending(const fs::path& file) {
  std::string e = file.extension().string();
  std::ranges::transform(e, e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

bool has_picture_name(const fs::path& file) {
  return std::ranges::find(kEndings, ending(file)) != kEndings.end();
}

std::string read_bytes(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) refuse(file, "there is no such file");
  if (!fs::is_regular_file(file, error)) refuse(file, "it is not a file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size == 0) refuse(file, "it is empty");
  if (size > kLargestFile) refuse(file, "it is larger than any picture");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.good() && !stream.eof()) refuse(file, "it cannot be read");
  return bytes;
}

// Decoders fill in the missing part of a picture with grey and say nothing.
void check_complete(const fs::path& file, std::string_view bytes) {
  const auto starts = [&](std::string_view mark) { return bytes.starts_with(mark); };
  if (starts("\x89PNG") &&
      bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 64)).find("IEND") ==
          std::string_view::npos)
    refuse(file, "it is cut short");
  // A small picture inside of the file ends with the same mark.
  if (starts("\xFF\xD8") && bytes.substr(bytes.size() - std::min(bytes.size(), kJpegTail)).find("\xFF\xD9") ==
                                std::string_view::npos)
    refuse(file, "it is cut short");
}

Image to_image(const cv::Mat& m) {
  Image image(m.cols, m.rows, m.channels());
  cv::Mat target(m.rows, m.cols, m.type(), image.data.data());
  m.copyTo(target);
  return image;
}

// a2 before a10.
bool natural_less(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename().string();
  const std::string y = b.filename().string();
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < x.size() && j < y.size()) {
    if (digit(x[i]) && digit(y[j])) {
      const auto number = [&digit](const std::string& s, std::size_t& k) {
        while (k + 1 < s.size() && s[k] == '0' && digit(s[k + 1])) ++k;
        const std::size_t from = k;
        while (k < s.size() && digit(s[k])) ++k;
        return s.substr(from, k - from);
      };
      const std::string n = number(x, i);
      const std::string m = number(y, j);
      if (n.size() != m.size()) return n.size() < m.size();
      if (n != m) return n < m;
    } else {
      if (x[i] != y[j]) return x[i] < y[j];
      ++i;
      ++j;
    }
  }
  return x.size() - i < y.size() - j;
}

}  // namespace

Image read_picture(const fs::path& file, int channels) {
  const std::string bytes = read_bytes(file);
  check_complete(file, bytes);
  cv::Mat decoded;
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));  // NOLINT
    decoded = cv::imdecode(raw, channels == 1 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    decoded.release();  // too large for the decoder
  }
  if (decoded.empty()) refuse(file, "it is not a picture, or damaged");
  if (std::max(decoded.cols, decoded.rows) > kLargestEdge) refuse(file, "it is larger than 8192 pixels");
  return to_image(decoded);
}

void check_size(const Image& picture, const std::string& name, const CameraModel& camera) {
  if (picture.width == camera.width && picture.height == camera.height) return;
  refuse(name, "it is " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                   ", the camera's pictures are " + std::to_string(camera.width) + " x " +
                   std::to_string(camera.height));
}

void write_picture(const fs::path& file, const ImageView& picture) {
  std::vector<unsigned char> bytes;
  const fs::path part = file.string() + ".part";
  std::ofstream stream;
  if (!picture.empty() && cv::imencode(".png", matrix(picture), bytes)) {
    stream.open(part, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  stream.close();
  std::error_code error;
  if (stream) fs::rename(part, file, error);
  if (!stream || bytes.empty() || error)
    throw FaultError(FaultCode::cannot_write, "cannot write " + file.string());
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) refuse(folder, "there is no such folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (has_picture_name(entry.path())) files.push_back(entry.path());
  if (files.empty()) refuse(folder, "there is no picture in it (.png .jpg .bmp .tif .pgm .ppm)");
  std::ranges::sort(files, natural_less);
  return files;
}

struct PictureSource::Film {
  cv::VideoCapture capture;
};

PictureSource::PictureSource(const fs::path& source) : source_(source) {
  std::error_code error;
  if (!fs::exists(source, error)) refuse(source, "there is no such file or folder");
  if (fs::is_directory(source, error)) {
    files_ = pictures_in(source);
  } else if (has_picture_name(source)) {
    files_ = {source};
  } else {
    film_ = std::make_unique<Film>();
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // what it says is said below
    if (!film_->capture.open(source.string(), cv::CAP_FFMPEG) || !film_->capture.isOpened())
      refuse(source, "it is neither a picture nor a film that can be read");
  }
}
PictureSource::PictureSource(PictureSource&&) noexcept = default;
PictureSource& PictureSource::operator=(PictureSource&&) noexcept = default;
PictureSource::~PictureSource() = default;

bool PictureSource::next(SourcePicture& picture) {
  if (!film_) {
    if (number_ >= files_.size()) return false;
    picture.name = files_[number_].string();
    picture.image = read_picture(files_[number_]);
    ++number_;
    return true;
  }
  cv::Mat frame;
  if (!film_->capture.read(frame) || frame.empty()) {
    if (number_ == 0) refuse(source_, "there is no picture in the film");
    // Containers tell the number of pictures, some of them roughly.
    const double told = film_->capture.get(cv::CAP_PROP_FRAME_COUNT);
    const auto seen = static_cast<double>(number_);
    if (told > 0 && seen < kLeastShare * told)
      refuse(source_, "it breaks off after " + std::to_string(number_) + " of " +
                          std::to_string(static_cast<long>(told)) + " pictures");
    return false;
  }
  if (frame.type() != CV_8UC3) refuse(source_, "its pictures are not of 8 bits and three colours");
  picture.name = source_.string() + ":" + std::to_string(number_++);
  picture.image = to_image(frame);
  // Of the picture that was read last. OpenCV takes the time of decoding for one shown at 0, which may lie before it.
  picture.t = std::max(0.0, 1e-3 * film_->capture.get(cv::CAP_PROP_POS_MSEC));
  return true;
}

}  // namespace mrroc::vsp
