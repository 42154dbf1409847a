// SPDX-License-Identifier: MIT
// A file that appears at its path whole or not at all: the bytes go to a temporary file in the same
// folder, which is flushed to the disk and renamed over the target by commit(). Until then, and
// after any failure, whatever stood at the path stands there unchanged and the temporary is
// removed. The temporary has no name before commit(), so that a program that is killed leaves
// nothing, but where the file system can't do that (NFS): there it is .malus-PID-NUMBER.tmp, and
// what is left of it may be deleted. Nobody else does: its process may live on another machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace renderer {

/// Throws InputError unless a file can be made at `path`: its folder exists and is writable, and
/// the path itself is free or an ordinary writable file. Meant to be asked before hours of work,
/// not after.
void check_writable(const std::string& path);

class AtomicFile {
 public:
  /// Throws InputError as check_writable does, WorkError if the temporary cannot be made.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes at the current position. A failure throws WorkError, and commit() will throw it again:
  /// libraries that swallow exceptions in destructors cannot make a broken file look finished.
  void write(const void* bytes, std::size_t count);
  std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position) { position_ = position; }

  void commit();

 private:
  [[noreturn]] void fail(const char* what, int error);

  std::string path_;       // as the user named it, for messages
  std::string target_;     // with a symbolic link followed
  std::string temporary_;  // empty once there is nothing to remove
  std::string failure_;    // the first failure's message
  int descriptor_ = -1;
  std::uint64_t position_ = 0;
};

/// The whole of a small file (text, an encoded picture) in one call.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace renderer
