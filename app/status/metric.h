/// What a field of a status is as a number: for Prometheus, and how many digits of it the file has.
///
/// Threads  values; any.
#pragma once

#include <string_view>

namespace frustumscreen {

/// A family of Prometheus, or one sample of several. A text is 1, with itself as the label's value; a word from a list is a sample for
/// each, of which its own is 1; a list is its length; what may be null in the file is 1 where it is not.
struct Metric {
    std::string_view name = {}; ///< without frustumscreen_; counters end in _total; empty: there is none
    std::string_view help = {};
    double scale = 1.0;          ///< to base units
    std::string_view label = {}; ///< its name
    std::string_view of = {};    ///< its value, where neither a text nor a word says it
};

struct Digits {
    double scale = 1.0; ///< the file's number for 1
    double steps = 1e3; ///< in 1 of the file's unit: a number is rounded to whole ones
};

} // namespace frustumscreen
