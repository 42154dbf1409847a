// SPDX-License-Identifier: MIT
#include "checkpoint.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "../io/atomic_file.hpp"
#include "../io/digest.hpp"
#include "../io/input_error.hpp"

namespace renderer {
namespace {

// The file: a mark, this machine's order of bytes, the identity as text, the state, the film, and a
// digest of all that. Numbers are as they are in memory, by design: another machine's last bits
// would be others anyway.
constexpr std::string_view mark = "malus checkpoint 1\n";
constexpr std::uint64_t byte_order = 0x0102030405060708ull;

static_assert(std::is_trivially_copyable_v<Counters> && std::is_trivially_copyable_v<PixelSum>);

class Writer {
 public:
  explicit Writer(const std::string& path) : file_(path) { raw(mark); }
  template <class T>
  void number(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw({reinterpret_cast<const char*>(&value), sizeof value});
  }
  template <class T>
  void sequence(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    number(static_cast<std::uint64_t>(values.size()));
    raw({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  void commit() {
    const std::uint64_t all = digest_.value();
    file_.write(&all, sizeof all);
    file_.commit();
  }

 private:
  void raw(std::string_view bytes) {
    file_.write(bytes.data(), bytes.size());
    digest_.add(bytes);
  }

  AtomicFile file_;
  Digest digest_;
};

class Reader {
 public:
  explicit Reader(const std::string& path)
      : path_(path), file_(path, std::ios::binary), left_(std::filesystem::file_size(path)) {
    std::string start(std::min<std::uintmax_t>(left_, mark.size()), '\0');
    raw(start.data(), start.size());
    if (start != mark) fail("is not a checkpoint; it is left as it is");
  }
  template <class T>
  T number() {
    T value;
    raw(&value, sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> sequence() {
    const auto count = number<std::uint64_t>();
    if (count > left_ / sizeof(T)) damaged();
    std::vector<T> values(static_cast<std::size_t>(count));
    raw(values.data(), values.size() * sizeof(T));
    return values;
  }
  void end() {
    const std::uint64_t all = digest_.value();
    if (number<std::uint64_t>() != all || left_ != 0) damaged();
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError({path_, 0}, problem);
  }
  [[noreturn]] void damaged() const {
    fail("is a damaged checkpoint (cut short, or changed); remove it to begin anew");
  }

 private:
  void raw(void* bytes, std::size_t count) {
    if (count > left_) damaged();
    left_ -= count;
    if (!file_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count)))
      fail("cannot be read; is reading permitted?");
    digest_.add({static_cast<const char*>(bytes), count});
  }

  std::string path_;
  std::ifstream file_;
  std::uintmax_t left_;
  Digest digest_;
};

std::string to_text(const std::map<std::string, std::string>& identity) {
  std::string text;
  for (const auto& [name, value] : identity) text += name + '\n' + value + '\n';
  return text;
}

/// Names the first difference: the two texts have the same form, but for those of other versions.
void compare(const Reader& reader, std::string_view there, std::string_view here) {
  const auto line = [](std::string_view& text) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string result(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return result;
  };
  while (there != here) {
    const std::string name = line(there), value = line(there);
    const std::string name_here = line(here), value_here = line(here);
    if (name == name_here && value == value_here && !name.empty()) continue;
    if (name != name_here)
      reader.fail("is a checkpoint of another version of malus-render; it is left as it is");
    reader.fail("is a checkpoint of another rendering: its " + name + " is \"" + value +
                "\", and that of this one is \"" + value_here + "\"; it is left as it is");
  }
}

}  // namespace

Checkpoint::Checkpoint(std::string path, double every, std::map<std::string, std::string> identity)
    : path_(std::move(path)), every_(every), identity_(std::move(identity)) {
  check_writable(path_);
}

bool Checkpoint::load(RenderState& state, Film& film) const {
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) return false;
  if (::access(path_.c_str(), R_OK) != 0)
    throw InputError({path_, 0}, "cannot be read; is reading permitted?");
  Reader reader(path_);
  if (reader.number<std::uint64_t>() != byte_order) reader.damaged();
  const std::vector<char> identity = reader.sequence<char>();
  const std::string here = to_text(identity_);
  const std::string_view there(identity.data(), identity.size());
  RenderState read;
  const bool same = there == here;
  if (same) {
    read.done = reader.number<std::uint64_t>();
    read.last = reader.number<std::uint64_t>();
    read.seconds = reader.number<double>();
    read.counters = reader.number<Counters>();
    read.finished = reader.sequence<std::uint8_t>();
    const std::vector<PixelSum> sums = reader.sequence<PixelSum>();
    reader.end();
    if (sums.size() != film.sums().size()) reader.damaged();
    std::copy(sums.begin(), sums.end(), film.sums().begin());
    state = std::move(read);
  } else {
    compare(reader, there, here);
  }
  return true;
}

void Checkpoint::save(const RenderState& state, const Film& film) {
  try {
    Writer writer(path_);
    writer.number(byte_order);
    const std::string identity = to_text(identity_);
    writer.sequence(std::span<const char>(identity));
    writer.number(state.done);
    writer.number(state.last);
    writer.number(state.seconds);
    writer.number(state.counters);
    writer.sequence(std::span<const std::uint8_t>(state.finished));
    writer.sequence(film.sums());
    writer.commit();
    failure_.clear();
  } catch (const InputError& error) {
    failure_ = error.what();
  } catch (const WorkError& error) {
    failure_ = error.what();
  }
}

void Checkpoint::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace renderer
