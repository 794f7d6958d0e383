#include "app/programs/bake/bake_work.h"

#include "app/pack/attribution.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_magic.h"
#include "app/programs/bake/artifact_words.h"
#include "app/programs/bake/auto_cells.h"
#include "app/programs/bake/behaviours_of.h"
#include "app/programs/bake/check_scan.h"
#include "app/programs/bake/load_scan.h"
#include "app/programs/bake/put_cells.h"
#include "app/programs/bake/put_site.h"
#include "app/programs/bake/scan_about.h"
#include "app/programs/bake/states_of.h"
#include "app/programs/bake/torch_contents.h"
#include "app/programs/bake/used_machine.h"
#include "app/programs/batch/content_hash.h"
#include "app/programs/common/progress_line.h"
#include "app/programs/common/time_left.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/best_turn.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/hotspots.h"
#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

/// Checks a scan's hotspots before texts and levels are made, with the bake's options, so that hotspots which pass here
/// pass the bake.
Result<void> check_hotspots(const bake::SourceMesh& mesh, const bake::BakeOptions& options) {
    if (options.hotspots.empty()) {
        return {};
    }
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    const Result<bake::BoxFrame> frame = bake::make_box_frame(mesh, {up, options.turn_deg, options.lift});
    if (!frame) {
        return {}; // the bake reports the scan's error
    }
    const std::vector<glm::dvec3> points = bake::in_box(mesh, *frame);
    const bake::SourceScene scene(mesh, points);
    for (const bake::GivenHotspot& given : options.hotspots) {
        TRY_VOID(without_value(bake::put_on_surface(given, scene, *frame, options.prop.zone)));
    }
    return {};
}

Result<void> describe(pack::Pack& pack, const BakeRequest& request) {
    pack.id = request.id;
    pack.title = request.captions.front().title;
    pack.captions = request.captions;
    for (const pack::PackCaption& caption : pack.captions) {
        pack.languages.push_back(caption.language);
    }
    pack.provenance.source_name = request.scan.filename().string();
    TRY(pack.provenance.source_sha256, hash_of_file(request.scan));
    pack::put_scan_rights(pack, request.rights);
    return {};
}

/// Reports losses on standard error; with --strict they are an error.
Result<void> tell(const std::vector<bake::SourceNote>& notes, const BakeRequest& request) {
    TRY_VOID(check_losses(notes, request));
    for (const std::string& text : losses_in(notes)) {
        say_line("frustumscreen-bake", fmt::format("{}: lost: {}", request.scan.string(), text));
    }
    return {};
}

/// Sets and speaks the texts. Runs before the bake: it takes seconds, the bake minutes, so errors are reported early.
Result<ArtifactWords> set_and_speak(const BakeRequest& request,
                                    std::span<const pack::PackBehaviour> behaviours,
                                    const bake::BakeOptions& options, std::vector<bake::SourceNote>& notes) {
    options.progress("texts and speech", 0.0);
    TRY(ArtifactWords words, words_of(request, behaviours));
    for (const std::string& lost : words.lost) {
        notes.push_back({bake::SourceNote::Kind::Lost, lost});
    }
    TRY_VOID(tell(notes, request));
    return words;
}

/// Expected duration of a bake's stages; used for the time left only.
struct ExpectedTime {
    double reading_s = 0.0;
    double bake_s = 0.0;
    [[nodiscard]] double all_s() const { return reading_s + bake_s; }
    [[nodiscard]] double reading_share() const { return reading_s / all_s(); }
};

ExpectedTime expected_time(const std::filesystem::path& scan) {
    constexpr double bytes_a_second = 4e7;
    constexpr double small_bake_s = 8.0;
    constexpr double large_bake_s = 60.0;
    constexpr double large_bytes = 1e8;
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(scan, unknown);
    const double bytes = unknown ? 0.0 : static_cast<double>(size);
    return {bytes / bytes_a_second,
            std::lerp(small_bake_s, large_bake_s, std::min(1.0, bytes / large_bytes))};
}

/// Reading is one stage, and those of the bake follow.
TimeLeft time_left(const ExpectedTime& expected) {
    std::vector<double> ends;
    for (const bake::BakeStage& stage : bake::stages::all) {
        ends.push_back(std::lerp(expected.reading_share(), 1.0, stage.begin));
    }
    ends.push_back(1.0);
    std::erase_if(ends, [&](double end) { return end <= 0.0; });
    return {ends, expected.all_s()};
}

/// Share of the work of a bake with cells that the whole artifact is.
constexpr double whole_share = 0.5;

/// The cell that each node of the file became, if any.
using CellsOfNodes = std::vector<std::optional<std::size_t>>;

/// Divides the artifact into cells or regions, if that is wanted: into those of the file's nodes, into those that are found, or
/// into the regions of a site. `behaviours` number their titles in `texts`.
Result<CellsOfNodes> put_parts(pack::Pack& pack, const bake::SourceMesh& mesh, const BakeRequest& request,
                               const bake::BakeOptions& options,
                               const std::vector<pack::PackBehaviour>& behaviours,
                               std::vector<pack::SetLanguage>& texts, BakeResult& result) {
    CellsOfNodes cell_of;
    if (result.cells.nodes) {
        TRY(PutCells put,
            at(request.scan.string(), put_cells(pack, mesh, behaviours, options, result.notes)));
        result.world = std::move(put.world);
        cell_of = std::move(put.cell_of);
        number_titles(behaviours, result.world.behaviours, texts);
        TRY_VOID(check_losses(result.notes, request));
    }
    if (result.cells.found) {
        TRY(AutoCells found, at(request.scan.string(), put_auto_cells(pack, mesh, options)));
        result.cells.why = std::move(found.why);
        result.world = std::move(found.world);
    }
    if (request.site) {
        TRY(MadeSite site,
            at(request.scan.string(), put_site(pack, mesh, *request.site, options, result.notes)));
        result.site = std::move(site.told);
        result.world = std::move(site.world);
        TRY_VOID(check_losses(result.notes, request));
    }
    return cell_of;
}

/// Names the things that a kiosk needs and the pack lacks.
std::vector<std::string> missing_in(const pack::Pack& pack, const BakeRequest& request) {
    std::vector<std::string> missing = pack::missing_in(pack, request.rights);
    if (request.output.extension() != ".fspack" && !request.watched) {
        missing.push_back(
            fmt::format("the name's end: a kiosk takes only *.fspack and ignores {}; call it {}.fspack",
                        request.output.filename().string(), request.output.stem().string()));
    }
    return missing;
}

Result<BakeResult> bake_file(const BakeRequest& written, bake::BakeOptions options) {
    const auto start = std::chrono::steady_clock::now();
    const double read = expected_time(written.scan).reading_share();
    const auto progress = std::exchange(options.progress, {});
    TRY(const bake::SourceMesh mesh,
        load_scan(written, [&](std::string_view step, double done) { progress(step, read * done); }));
    BakeResult result;
    result.cells = choose_cells(written.cells, mesh, written.behaviours.size(), hides_parts(written));
    const bool in_parts = result.cells.nodes || result.cells.found || written.site.has_value();
    const double whole = in_parts ? whole_share : 1.0;
    const auto begin_stages = [&](double begin, double end) {
        options.progress = [&progress, begin, end](std::string_view step, double done) {
            progress(step, std::lerp(begin, end, done));
        };
    };
    begin_stages(read, std::lerp(read, 1.0, whole));
    result.notes = mesh.notes;
    TRY(const std::vector<pack::PackBehaviour> behaviours,
        movements_of(written, mesh, result.cells, result.notes));
    TRY(result.states, check_states(written, mesh, behaviours));
    TRY_VOID(check_output_is_no_input(written.output, mesh.side_files));
    options.unlit = options.unlit || mesh.is_unlit;
    CompletedRequest all = completed(written, mesh.about);
    const BakeRequest& request = all.request;
    result.file = request.output;
    result.prop = options.prop;
    result.notes.insert(result.notes.end(), all.notes.begin(), all.notes.end());
    result.up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    result.up_given = !options.up.empty();
    result.turn_given = request.turn_deg.has_value();
    options.turn_deg = result.turn_deg =
        request.turn_deg ? *request.turn_deg
                         : bake::best_turn_deg(mesh, result.up, options.lift, options.prop.shape);
    TRY_VOID(check_hotspots(mesh, options));
    if (request.site) {
        TRY_VOID(at(request.scan.string(), check_site(mesh, *request.site, options)));
    }
    TRY(TorchContents torches, contents_of(request, mesh, Contents::Read));
    result.notes.insert(result.notes.end(), torches.notes.begin(), torches.notes.end());
    result.torches = torches.told;
    options.torches = std::move(torches.torches);
    options.torch_parts = std::move(torches.parts);
    TRY(ArtifactWords words, set_and_speak(request, behaviours, options, result.notes));
    result.silent = std::move(words.silent);
    TRY(const bake::ScanMeasures measures, at(request.scan.string(), bake::measure_scan(mesh, options)));
    result.scan = summary_of(mesh, measures);
    TRY(pack::Pack pack, at(request.scan.string(), bake::bake(mesh, options)));
    TRY_VOID(describe(pack, request));
    if (in_parts) {
        begin_stages(std::lerp(read, 1.0, whole), 1.0);
    }
    TRY(const CellsOfNodes cell_of, put_parts(pack, mesh, request, options, behaviours, words.set, result));
    TRY(std::vector<pack::PackState> states, states_of(request, mesh, result.world, cell_of));
    TRY_VOID(at(request.scan.string(), pack::put_states(pack, std::move(states))));
    result.rights = request.rights;
    result.missing = missing_in(pack, request);
    pack::put_sounds(pack, words.spoken);
    pack::put_set_texts(pack, words.set);
    result.pack = std::move(pack);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// Checks, before the work, that the output replaces no scan and no unknown file, and that it can be written.
Result<void> check_output(const BakeRequest& request) {
    TRY_VOID(check_output_is_no_input(request.output, request.inputs));
    TRY_VOID(check_output_place(request.output, bake::space_for_pack(request.options.size)));
    std::error_code ignored;
    if (!request.force && std::filesystem::exists(request.output, ignored) &&
        !pack::begins_as_pack(request.output)) {
        return bad_input("bake.not_a_pack",
                         "{}: this file exists and is not a pack; choose another name for the output, or add "
                         "--force to replace it",
                         request.output.string());
    }
    return {};
}

} // namespace

Result<BakeResult> bake_pack(const BakeRequest& request) {
    TRY_VOID(check_output(request));
    ProgressLine progress("baking: ");
    bake::BakeOptions options = request.options;
    TimeLeft left = time_left(expected_time(request.scan));
    options.progress = [&](std::string_view step, double done) {
        const double now_s = progress.passed_s();
        left.report(now_s, done);
        progress.show_share(step, done, left.seconds(now_s));
    };
    TRY(BakeResult result, bake_file(request, std::move(options)));
    TRY(const Bytes bytes, at(request.output.string(), pack::write_pack(result.pack)));
    TRY(result.parts, at(request.output.string(), pack::list_pack_parts(bytes)));
    result.file_bytes = bytes.size();
    TRY_VOID(write_file(request.output, bytes));
    result.used = used_machine();
    return result;
}

} // namespace frustumscreen::programs
