// SPDX-License-Identifier: MIT
#include "parameters.hpp"

#include <algorithm>

#include "text.hpp"

namespace renderer {
namespace {

constexpr std::size_t longest_value = std::size_t{1} << 20;
constexpr std::size_t most_put_in = std::size_t{1} << 26;

constexpr std::string_view name_rule = "; allowed: letters, digits and underscores";

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_name_character);
}

template <typename Names>
std::string list(const Names& names) {
  return names.empty() ? "none" : joined(std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace

Parameters::Parameters(const std::map<std::string, std::string>& definitions) {
  for (const auto& [name, value] : definitions) {
    if (!is_name(name)) {
      throw InputError("-D " + in_quotes(name + "=" + value) + ": not the name of a parameter" +
                       std::string(name_rule));
    }
    values_.emplace(name, value);
    defined_.insert(name);
  }
}

void Parameters::set_default(const Element& element) {
  const std::string& name = element.text("name");
  if (!is_name(name)) element.fail("not the name of a parameter" + std::string(name_rule));
  values_.emplace(name, element.text("value"));
  known_.insert(name);
}

std::string Parameters::substitute(std::string_view text, const Location& where) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '$') {
      out += text[++i];
      continue;
    }
    if (text[i] != '$') {
      out += text[i];
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && is_name_character(text[end])) ++end;
    const std::string name(text.substr(i + 1, end - i - 1));
    const auto at = values_.find(name);
    if (at == values_.end()) {
      std::vector<std::string> names;
      for (const auto& entry : values_) names.push_back(entry.first);
      throw InputError(where, "undefined parameter " + in_quotes("$" + name) + " in " +
                                  in_quotes(text) + "; allowed: " + list(names) + " (give -D " +
                                  name + "=value, or a <default> before its use)");
    }
    known_.insert(name);
    put_in(name, at->second, out, where);
    i = end - 1;
  }
  return out;
}

void Parameters::put_in(const std::string& name, const std::string& value, std::string& out,
                        const Location& where) {
  const std::size_t length = out.size() + value.size();
  if (length > longest_value)
    throw InputError(
        where, "with the value of " + in_quotes("$" + name) + ", " + in_quotes(value) +
                   ", an attribute has " + std::to_string(length) +
                   " bytes; allowed where parameters are put in: " + std::to_string(longest_value));
  put_in_ += value.size();
  if (put_in_ > most_put_in)
    throw InputError(where, "with the value of " + in_quotes("$" + name) + ", " + in_quotes(value) +
                                ", " + std::to_string(put_in_) +
                                " bytes are put in for parameters; allowed: " +
                                std::to_string(most_put_in) + " in all");
  out += value;
}

void Parameters::reject_unused(const std::string& file) const {
  for (const std::string& name : defined_) {
    if (known_.count(name)) continue;
    throw InputError({file, 0}, "-D " + name + "=" + values_.find(name)->second +
                                    ": the scene has no such parameter; allowed: " + list(known_));
  }
}

}  // namespace renderer
