/// The exhibit's state as one JSON document with fixed keys: docs/status.md.
///
/// Threads  pure; any.
#pragma once

#include "app/status/known_exhibit.h"

#include <string>

namespace frustumscreen::status {

[[nodiscard]] std::string status_document(const KnownExhibit& known);

} // namespace frustumscreen::status
