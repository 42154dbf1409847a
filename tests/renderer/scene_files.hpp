// SPDX-License-Identifier: MIT
// Scene and mesh files for the tests of their readers, in a folder that lives as long as the test.
#pragma once

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "io/input_error.hpp"
#include "scene/xml_reader.hpp"

namespace scene_test {

class Folder {
 public:
  Folder() {
    static int counter = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("malus_scene_" + std::to_string(getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

using Definitions = std::map<std::string, std::string>;
using Scene = std::shared_ptr<const renderer::Object>;

/// The content stands in lines 2 and on of the file scene.xml.
inline std::string in_scene(std::string_view content) {
  return "<scene version=\"3.0.0\">\n" + std::string(content) + "\n</scene>\n";
}

inline Scene read(std::string_view content, const Definitions& definitions = {}) {
  const Folder folder;
  return renderer::read_scene(folder.write("scene.xml", in_scene(content)), definitions);
}

/// The message of the InputError that the action throws, or "no error".
template <typename Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const renderer::InputError& error) {
    return error.what();
  }
  return "no error";
}

inline std::string read_error(std::string_view content, const Definitions& definitions = {}) {
  return error_of([&] { read(content, definitions); });
}

inline bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace scene_test

/// Every part stands in the message.
#define CHECK_MESSAGE_HAS(message, ...)                                                \
  do {                                                                                 \
    const std::string message_ = (message);                                            \
    for (const std::string& part_ : std::initializer_list<std::string>{__VA_ARGS__}) { \
      INFO("message: ", message_);                                                     \
      INFO("expected part: ", part_);                                                  \
      CHECK(scene_test::contains(message_, part_));                                    \
    }                                                                                  \
  } while (false)
