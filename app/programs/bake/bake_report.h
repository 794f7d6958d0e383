/// The report at the end of a bake: one screen of text for a person, JSON for programs.
///
/// Sizes and errors are those on a prop of usual size, of the kind that the pack is baked for.
/// Threads  pure; any.
#pragma once

#include "app/pack/attribution.h"
#include "app/pack/pack.h"
#include "app/pack/pack_contents.h"
#include "app/pack/pack_world.h"
#include "app/programs/bake/cells_choice.h"
#include "app/programs/bake/used_machine.h"
#include "app/programs/batch/scan_summary.h"
#include "app/programs/preview/preview_page.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/source_mesh.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// Everything that a bake decided and made.
struct BakeResult {
    std::filesystem::path file;
    std::uint64_t file_bytes = 0;
    pack::Pack pack;
    std::vector<pack::PackPart> parts;
    bake::BakedProp prop;
    std::string up;        ///< as "y" or "-z"
    bool up_given = false; ///< false: the format's
    double turn_deg = 0.0;
    bool turn_given = false; ///< false: chosen by the bake
    CellsChoice cells;
    pack::PackWorld world;         ///< empty: the pack has no cells
    std::vector<std::string> site; ///< its regions, a line each; empty: it is no site
    ScanSummary scan;
    std::vector<std::string> torches; ///< what each content of a torch shows, a line each
    std::vector<std::string> states;  ///< what each state is, a line each
    std::vector<bake::SourceNote> notes;
    std::vector<std::string> silent; ///< descriptions without speech, and why
    pack::ScanRights rights;
    std::vector<std::string> missing; ///< facts that the curator should add, a sentence each
    double seconds = 0.0;
    UsedMachine used;
    std::filesystem::path page; ///< the preview page; empty: none
    std::uint64_t page_bytes = 0;
};

/// The facts that the preview page shows.
[[nodiscard]] PreviewFacts preview_facts(const BakeResult& result);
/// Ends with a line break.
[[nodiscard]] std::string report_text(const BakeResult& result);
/// {file, bytes, title, seconds, processor_seconds, memory_bytes, prop, size_m, up, front, turn_deg, scale,
/// levels: [{technique, triangles, bytes, mean_mm, p95_mm, max_mm, colour_rmse}], default_level,
/// spoken: [languages], silent: [], lost: [], guessed: [], taken: [], missing: [], torches: [], states: [], site: [],
/// cells: {taken: none, nodes or found, why, cells: [{name, triangles}], behaviours: [{name, seconds, trigger}]},
/// scan: {as --check --json has it}, id, licence, author, source, page}; `page` only if there is one
[[nodiscard]] nlohmann::ordered_json report_json(const BakeResult& result);

} // namespace frustumscreen::programs
