/// The thread that reads an artifact, some of its texts or a page of a site, one at a time.
///
/// Threads  as BackgroundReader.
/// Errors   those of `prepare`, as an answer.
#pragma once

#include "app/residency/background_reader.h"
#include "app/residency/prepared_artifact.h"

#include <variant>

namespace frustumscreen::residency {

using ArtifactReader = BackgroundReader<std::variant<TextPictures, PreparedArtifact, PreparedPage>>;

} // namespace frustumscreen::residency
