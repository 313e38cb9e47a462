#include "planner/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "planner/console.hpp"
#include "planner/signals.hpp"

namespace surefoot::planner {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& path, int fault) {
  throw OutputError(fmt::format("{}: cannot write: {}", path.empty() ? "''" : path, std::strerror(fault)));
}

/// Writes, flushes to the disk and closes; 0 or errno.
int write_and_close(int descriptor, std::string_view text, bool flush) {
  int fault = 0;
  while (fault == 0 && !text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) text.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR) fault = errno;
  }
  if (fault == 0 && flush && ::fsync(descriptor) != 0) fault = errno;
  if (::close(descriptor) != 0 && fault == 0) fault = errno;
  return fault;
}

/// The descriptor of this process that a path names, as /dev/stdout (a link to /proc/self/fd/1) and /dev/fd/7 do; -1 if
/// none. What is open there is written to where it stands, be it a pipe, a socket or a file that others write to as
/// well.
int own_descriptor(const std::string& path) {
  for (const std::string_view folder : {"/proc/self/fd/", "/dev/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int number = -1;
    const char* end = path.data() + path.size();
    const auto read = std::from_chars(path.data() + folder.size(), end, number);
    return read.ec == std::errc() && read.ptr == end ? number : -1;
  }
  return -1;
}

/// Where a path leads, through symbolic links, dangling ones too, but not through own_descriptor.
std::string follow_links(const std::string& path) {
  std::error_code ignored;
  fs::path target = path;
  constexpr int most_links = 40;  // as the kernel's own limit
  for (int i = 0; i < most_links && own_descriptor(target.string()) < 0 && fs::is_symlink(target, ignored); ++i) {
    const fs::path link = fs::read_symlink(target, ignored);
    target = link.is_absolute() ? link : target.parent_path() / link;
  }
  return target.string();
}

/// Opens what is not replaced: a device, a FIFO, a descriptor that is open already.
int open_to_write(const std::string& target) {
  const int own = own_descriptor(target);
  return own < 0 ? ::open(target.c_str(), O_WRONLY | O_CLOEXEC) : ::fcntl(own, F_DUPFD_CLOEXEC, 0);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), target_(follow_links(path_)) {
  if (path_.empty()) fail(path_, ENOENT);
  struct stat status {};
  if (const int own = own_descriptor(target_); own >= 0) {
    if (::fcntl(own, F_GETFD) < 0) fail(path_, errno);
    replaceable_ = false;
  } else if (::stat(target_.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail(path_, EISDIR);
    if (::access(target_.c_str(), W_OK) != 0) fail(path_, errno);
    replaceable_ = S_ISREG(status.st_mode);
    mode_ = status.st_mode & 07777u;
  } else if (errno != ENOENT) {
    fail(path_, errno);
  } else {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    mode_ = 0666u & ~mask;
  }
  if (!replaceable_) return;
  ::close(make_temporary());
  drop_temporary();
}

OutputFile::~OutputFile() { drop_temporary(); }

void OutputFile::drop_temporary() {
  if (temporary_.empty()) return;
  const SignalsHeld held;
  ::unlink(temporary_.c_str());
  keep_on_signal(temporary_);
  temporary_.clear();
}

int OutputFile::make_temporary() {
  const fs::path target = target_;
  if (target.filename().empty()) fail(path_, EISDIR);
  std::string name = (target.parent_path() / (".surefoot-XXXXXX")).string();
  const SignalsHeld held;
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail(path_, errno);
  temporary_ = name;
  remove_on_signal(temporary_);
  if (::fchmod(descriptor, mode_) != 0) fail(path_, errno);
  return descriptor;
}

void OutputFile::stage(std::string_view text) {
  drop_temporary();
  const int descriptor = replaceable_ ? make_temporary() : open_to_write(target_);
  const int fault = descriptor < 0 ? errno : write_and_close(descriptor, text, replaceable_);
  if (fault != 0) fail(path_, fault);
}

void OutputFile::commit() {
  if (!replaceable_) return;
  const SignalsHeld held;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, errno);
  keep_on_signal(temporary_);
  temporary_.clear();
}

bool OutputFile::same_as(const std::string& other) const {
  std::error_code ignored;
  if (!replaceable_) return false;
  // weakly_canonical leaves a name without any existing part as it is: "x" and "./x" would differ.
  const auto place = [&](const std::string& name) {
    return fs::weakly_canonical(fs::absolute(name, ignored), ignored);
  };
  return place(target_) == place(follow_links(other)) || fs::equivalent(target_, other, ignored);
}

}  // namespace surefoot::planner
