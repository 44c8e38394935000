#include "mp/room_reserve.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/fault.hpp"

namespace mrroc::mp {

RoomReserve::RoomReserve(const std::filesystem::path& folder) : file_(folder / kFile) {
  const int file = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) throw FaultError(FaultCode::cannot_write, fmt::format("cannot write {}", file_.string()));
  const int error = ::fallocate(file, 0, 0, static_cast<off_t>(kSize)) == 0 ? 0 : errno;
  ::close(file);
  if (error == 0) return;
  release();
  if (error == ENOSPC || error == EDQUOT)
    throw FaultError(
        FaultCode::cannot_write,
        fmt::format("there is no room for what a run leaves behind: {} MB are kept free for its end in {}",
                    kSize / 1'000'000, folder.string()));
}

void RoomReserve::release() noexcept {
  std::error_code none;
  std::filesystem::remove(file_, none);
}

}  // namespace mrroc::mp
