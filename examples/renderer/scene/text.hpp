// SPDX-License-Identifier: MIT
// Small helpers for text a user wrote: strict numbers, lists, and how a value is shown in an error
// message.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../image/finite.hpp"

namespace renderer {

std::string_view trimmed(std::string_view text);

/// The whole text as one finite number; nothing for trailing characters, nan, inf or overflow.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

/// The parts between runs of blanks and commas, as in Mitsuba's lists.
std::vector<std::string_view> split_list(std::string_view text);

/// "text" in quotes, shortened and without control characters, for error messages.
std::string in_quotes(std::string_view text);

/// A number as short as it reads back exactly.
std::string shown(double value);

std::string joined(const std::vector<std::string>& parts);

/// At most `count` of the candidates, those that look most like `name` first.
std::vector<std::string> nearest(std::string_view name, std::vector<std::string> candidates,
                                 std::size_t count = 8);

}  // namespace renderer
