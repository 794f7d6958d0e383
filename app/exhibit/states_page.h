/// The table of states for people: docs/states.md, and the diagram drawn from it.
///
/// Threads  pure; any.
#pragma once

#include <string>

namespace frustumscreen::exhibit {

/// Markdown, for `frustumscreen states`.
[[nodiscard]] std::string states_page();
/// Graphviz's language, for `frustumscreen states --dot`.
[[nodiscard]] std::string states_graph();

} // namespace frustumscreen::exhibit
