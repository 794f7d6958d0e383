/// Looks at a scan as a bake does, without simplifying it, casting rays or speaking.
///
/// Threads  one caller.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "app/programs/batch/scan_summary.h"
#include "assets_baked/bake/scan_measures.h"
#include "assets_baked/bake/source_mesh.h"

#include <optional>
#include <vector>

namespace frustumscreen::programs {

struct CheckedScan {
    std::filesystem::path input;         ///< a scan, or a folder with an artifact.toml
    std::optional<Error> fault;          ///< why it cannot be baked
    ScanSummary summary;                 ///< without a format if the scan could not be read
    std::vector<std::string> parts;      ///< names of those that can be cells; empty: one that does not move
    std::vector<std::string> animations; ///< names of those that move parts
    std::vector<std::string> torches;    ///< what each content of a torch shows, a line each
    std::vector<std::string> states;     ///< what each state is, a line each
    std::vector<bake::SourceNote> notes;
};

/// `arguments.input` is the scan.
[[nodiscard]] CheckedScan check_scan(BakeArguments arguments);

/// Everything but the number of losses.
[[nodiscard]] ScanSummary summary_of(const bake::SourceMesh& mesh, const bake::ScanMeasures& measures);

} // namespace frustumscreen::programs
