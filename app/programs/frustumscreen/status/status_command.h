/// `frustumscreen status`: the exhibit's health from outside, for a person, a program or Prometheus; and its picture.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'status'. Exit status: 0 the exhibit is well; 1 it is not, its status is unknown, or the picture
/// could not be had (what is known is printed); 2 wrong use.
[[nodiscard]] int status_command(int argc, char** argv);

} // namespace frustumscreen::programs
