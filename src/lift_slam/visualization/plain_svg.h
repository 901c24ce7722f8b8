#pragma once

#include <string>

namespace lift_slam {

// A file of RenderSvgFile without CSS variables, which browsers know and other programs do not:
// each var(--NAME) becomes what the first :root of its style sheet, that of light pages, says.
std::string PlainSvg(std::string svg);

}  // namespace lift_slam
