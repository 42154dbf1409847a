// SPDX-License-Identifier: MIT
// A number that stands for bytes: equal for equal bytes, and for others by a chance of 2⁻⁶⁴. It
// finds mistakes, not forgers.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace renderer {

class Digest {
 public:
  /// The bytes, with their number: ("ab", "c") is not ("a", "bc").
  void add(std::string_view bytes) {
    add(static_cast<std::uint64_t>(bytes.size()));
    while (bytes.size() >= sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, bytes.data(), sizeof word);
      add(word);
      bytes.remove_prefix(sizeof word);
    }
    std::uint64_t rest = 0;
    for (const char c : bytes) rest = rest << 8 | static_cast<unsigned char>(c);
    add(rest);
  }
  std::uint64_t value() const { return state_; }
  /// 16 digits.
  std::string text() const {
    std::string digits(16, '0');
    for (std::size_t i = 0; i < 16; ++i)
      digits[i] = "0123456789abcdef"[state_ >> (60 - 4 * i) & 15];
    return digits;
  }

 private:
  /// SplitMix64's finaliser (Steele et al. 2014), of a state that every word before has a part in.
  void add(std::uint64_t word) {
    std::uint64_t x = std::rotl(state_, 23) ^ word;
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    state_ = x ^ (x >> 31);
  }

  std::uint64_t state_ = 0;
};

/// While it lives, whatever this thread reads of a scene's files is added to a digest, in the order
/// it is read: by contents, not by name, so that a scene is the same one on another machine.
class DigestOfReading {
 public:
  explicit DigestOfReading(Digest& digest) : before_(current()) { current() = &digest; }
  ~DigestOfReading() { current() = before_; }
  DigestOfReading(const DigestOfReading&) = delete;
  DigestOfReading& operator=(const DigestOfReading&) = delete;

  static void note(std::string_view bytes) {
    if (current() != nullptr) current()->add(bytes);
  }

 private:
  static Digest*& current() {
    thread_local Digest* digest = nullptr;
    return digest;
  }
  Digest* before_;
};

}  // namespace renderer
