/// `frustumscreen status`: how the exhibit is, from outside, for a person, a program or Prometheus; and its picture.
#pragma once

namespace frustumscreen {

/// Arguments after 'status'. Exit status: 0 the exhibit is well, 1 it is not, nothing is known of it, or the picture could not be
/// had (all that is known is printed); 2 wrong use.
[[nodiscard]] int status_command(int argc, char** argv);

} // namespace frustumscreen
