// SPDX-License-Identifier: MIT
#include "atomic_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "input_error.hpp"

namespace renderer {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Renaming over a symbolic link would replace the link; the user means the file it points to. A
/// link that points nowhere is itself the file to make.
std::string follow_link(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real.string();
}

/// Beyond the user's limit on file sizes (ulimit -f) a write kills the program, unless it is asked
/// to return an error as for any other full disk.
void turn_size_limit_into_error() {
  struct sigaction current {};
  if (::sigaction(SIGXFSZ, nullptr, &current) == 0 && current.sa_handler == SIG_DFL) {
    ::signal(SIGXFSZ, SIG_IGN);
  }
}

std::string temporary_name(const std::string& folder) {
  static std::atomic<unsigned> counter{0};
  return folder + "/.malus-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) +
         ".tmp";
}

/// A file's own entry, by which a file that has no name can be given one.
std::string entry_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// A file without a name, of which nothing is left when the program is killed; −1 where the file
/// system (NFS) or the system knows no such files.
int open_nameless(const std::string& folder) {
#ifdef O_TMPFILE
  const int descriptor = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  if (descriptor < 0 || ::access(entry_of(descriptor).c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
#else
  static_cast<void>(folder);
#endif
  return -1;
}

int open_temporary(const std::string& folder, std::string& name) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    name = temporary_name(folder);
    // 0666 and not mkstemp's 0600: the finished file gets the permissions the user's umask asks
    // for.
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

/// So that the rename itself survives a power cut. Not every file system can; that is no reason to
/// fail.
void flush_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void check_writable(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("cannot write \"" + path + "\": " + why);
  };
  if (path.empty()) refuse("the file name is empty");
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) refuse("it is a folder");
    // Renaming over /dev/null or a pipe would replace the device by a plain file.
    if (!S_ISREG(status.st_mode)) refuse("it exists and is not an ordinary file");
    if (::access(path.c_str(), W_OK) != 0) refuse("the file that is there: " + reason(errno));
  } else if (errno != ENOENT) {
    refuse(reason(errno));
  }
  if (path.back() == '/') refuse("a file name is missing after the last \"/\"");
  const std::string folder = folder_of(follow_link(path));
  if (::stat(folder.c_str(), &status) != 0) refuse("folder \"" + folder + "\": " + reason(errno));
  if (!S_ISDIR(status.st_mode)) refuse("\"" + folder + "\" is not a folder");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse("folder \"" + folder + "\": " + reason(errno));
  }
}

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  check_writable(path);
  turn_size_limit_into_error();
  target_ = follow_link(path);
  descriptor_ = open_nameless(folder_of(target_));
  if (descriptor_ < 0) descriptor_ = open_temporary(folder_of(target_), temporary_);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail("cannot make a temporary file beside it", error);
  }
  struct stat status {};
  if (::stat(target_.c_str(), &status) == 0) {
    // A file that is replaced keeps its permissions; where that isn't allowed it gets the usual
    // ones.
    [[maybe_unused]] const int ignored = ::fchmod(descriptor_, status.st_mode & 07777);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(const char* what, int error) {
  if (failure_.empty()) {
    failure_ = "cannot write \"" + path_ + "\": " + what + ": " + reason(error);
  }
  throw WorkError(failure_);
}

void AtomicFile::write(const void* bytes, std::size_t count) {
  const char* next = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(descriptor_, next, count, static_cast<off_t>(position_));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("writing failed", written < 0 ? errno : ENOSPC);
    const auto done = static_cast<std::size_t>(written);
    next += done;
    count -= done;
    position_ += done;
  }
}

void AtomicFile::commit() {
  if (!failure_.empty()) throw WorkError(failure_);
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail("flushing to the disk failed", errno);
  // A name can be given to a file only where there is none, so it takes its place by renaming, too.
  for (int attempt = 0; temporary_.empty(); ++attempt) {
    const std::string name = temporary_name(folder_of(target_));
    if (::linkat(AT_FDCWD, entry_of(descriptor_).c_str(), AT_FDCWD, name.c_str(),
                 AT_SYMLINK_FOLLOW) == 0)
      temporary_ = name;
    else if (errno != EEXIST || attempt == 100)
      fail("giving it a name failed", errno);
  }
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail("closing failed", errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("renaming failed", errno);
  temporary_.clear();
  flush_folder(folder_of(target_));
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace renderer
