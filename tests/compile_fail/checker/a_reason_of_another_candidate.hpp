// SPDX-License-Identifier: MIT
#pragma once

struct add_instead;
struct swap_the_arguments;

add_instead combine(int, int) = delete;
swap_the_arguments combine(double, int) = delete;
int combine(int, double);
