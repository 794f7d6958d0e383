/// The exhibit's state as metrics in Prometheus' text format, for node_exporter's textfile collector.
///
/// Units    base units: seconds, bytes, metres, ratios. Names of counters end in _total.
/// Source   Prometheus' exposition formats, text format 0.0.4; its page on metric and label naming.
/// Threads  pure; any.
#pragma once

#include "app/status/known_exhibit.h"

#include <string>

namespace frustumscreen::status {

/// If the exhibit does not run, its own metrics are left out and frustumscreen_up is 0.
[[nodiscard]] std::string prometheus_text(const KnownExhibit& known);

} // namespace frustumscreen::status
