/// A status field as a number: its Prometheus metric, and its digits in the file.
///
/// Threads  values; any.
#pragma once

#include <string_view>

namespace frustumscreen::status {

/// A Prometheus family, or one sample of several. A number is one sample. A text is one sample of value 1, with
/// the text as label value. A word from a list has a sample for each word of the list: 1 for its own, 0 for the
/// others. A list is its length. An object that may be null in the file is 1 if it is not null, else 0.
struct Metric {
    std::string_view name = {}; ///< without frustumscreen_; a counter's ends in _total; empty: no metric
    std::string_view help = {};
    double scale = 1.0;          ///< to base units
    std::string_view label = {}; ///< its name
    std::string_view of = {};    ///< its value, if neither a text nor a word gives it
};

struct Digits {
    double scale = 1.0; ///< the file's number for 1
    double steps = 1e3; ///< steps within 1 of the file's unit: a number is rounded to whole steps
};

} // namespace frustumscreen::status
