/// The common part of frustumscreen-bench's commands: each command has its own file with one function
/// `BenchCommand ..._command(CommandLine&)` that declares its options and runs it.
///
/// Threads  one.
/// Errors   as Result; bench_main.cpp prints the sentence to standard error.
#pragma once

#include "app/bench/measures/technique_set.h"
#include "app/bench/measures/time_left.h"
#include "app/bench/techniques/pack_level.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/progress_line.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/time.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

/// The current step of a long run, and its remaining time.
class BenchProgress {
public:
    /// Sets the planned steps; the remaining time then covers the whole run. Without a plan it covers each
    /// step alone.
    void plan(std::vector<bench::WorkStep> steps) { time_left_ = bench::TimeLeft(std::move(steps)); }
    void show(const std::string& step, double done);
    void clear() { line_.clear(); }

private:
    ProgressLine line_;
    MonotonicTime started_ = monotonic_now();
    bench::TimeLeft time_left_;
};

struct BenchCommand {
    CommandLine options; ///< the subcommand's; `parsed()` once it was chosen
    std::function<Result<void>(BenchProgress&)> run;
};

/// Output folder and settings; every command has these options.
struct BenchPlace {
    std::filesystem::path out;
    std::vector<std::filesystem::path> configs; ///< empty: the near and the shipped set-up
};
/// --out and --config.
void add_place_options(CommandLine& command, BenchPlace& place);
/// --samples.
void add_picture_options(CommandLine& command, bench::PictureOptions& picture);
/// --poses and --seed.
void add_pose_options(CommandLine& command, int& poses, std::uint64_t& seed);

/// A pack and its source file.
struct BenchArtifact {
    std::filesystem::path pack;
    std::filesystem::path mesh;
};
/// --pack and --mesh.
void add_artifact_options(CommandLine& command, BenchArtifact& artifact);

struct LoadedArtifact {
    pack::VerifiedPack pack;
    std::shared_ptr<const bake::SourceMesh> mesh;
};
/// Warns on standard error if the mesh is not the pack's source.
[[nodiscard]] Result<LoadedArtifact> load_artifact(const BenchArtifact& artifact);
[[nodiscard]] Result<std::vector<bench::SetUp>> load_set_ups(const BenchPlace& place);

/// Names and contents.
using OutputFiles = std::vector<std::pair<std::string, std::string>>;
/// Writes files into --out; stops at the first failure.
[[nodiscard]] Result<void> write_all(const std::filesystem::path& folder, const OutputFiles& files);
/// Draws tables in `folder`, each as an SVG next to it.
[[nodiscard]] Result<void> draw_all(const std::filesystem::path& folder,
                                    const std::vector<std::string>& tables);

/// Measures one artifact in every set-up: `measure(set_up, pack, mesh, steps)` returns a result whose `worst`
/// is a picture; its `table` is printed, the picture is written to NAME_SETUP.png; `files_of` makes the
/// tables of all results.
template <typename Measure, typename Table, typename Files>
[[nodiscard]] Result<void>
measure_set_ups(const std::string& name, const BenchPlace& place, const BenchArtifact& measured,
                BenchProgress& progress, const Measure& measure, const Table& table, const Files& files_of) {
    TRY(const std::vector<bench::SetUp> set_ups, load_set_ups(place));
    TRY(const LoadedArtifact artifact, load_artifact(measured));
    const auto steps = [&progress](const std::string& step, double done) { progress.show(step, done); };
    using Measured =
        typename decltype(measure(set_ups.front(), *artifact.pack, artifact.mesh, steps))::value_type;
    std::vector<Measured> results;
    OutputFiles files;
    for (const bench::SetUp& set_up : set_ups) {
        TRY(Measured result, measure(set_up, *artifact.pack, artifact.mesh, steps));
        progress.clear();
        fmt::print("{}\n", table(result));
        std::fflush(stdout);
        files.emplace_back(name + "_" + set_up.name + ".png", as_text(image::encode_png(result.worst)));
        results.push_back(std::move(result));
    }
    for (auto& file : files_of(results)) {
        files.push_back(std::move(file));
    }
    return write_all(place.out, files);
}

/// Every level of a pack and its peers against a ray cast.
[[nodiscard]] BenchCommand error_time_command(CommandLine& app);
/// The exhibit's estimates of its picture error against a ray cast.
[[nodiscard]] BenchCommand estimate_command(CommandLine& app);
/// The prop's pose from its tags, in rendered scenes.
[[nodiscard]] BenchCommand tags_command(CommandLine& app);
/// The visitor's eye position from a camera, in rendered scenes.
[[nodiscard]] BenchCommand visitor_command(CommandLine& app);
/// Cost against the source's size, for the built-in amphora.
[[nodiscard]] BenchCommand scaling_command(CommandLine& app);
/// The visitor's view against an ordinary ray cast.
[[nodiscard]] BenchCommand projection_command(CommandLine& app);
/// The prop moved in steps of 0.1 pixel, against the ray cast.
[[nodiscard]] BenchCommand shimmer_command(CommandLine& app);
/// Numerical stability in stiff and extreme cases.
[[nodiscard]] BenchCommand stability_command(CommandLine& app);
/// The results of several artifacts on one sheet.
[[nodiscard]] BenchCommand plot_command(CommandLine& app);
/// The tables of a page, from measured CSV files.
[[nodiscard]] BenchCommand report_command(CommandLine& app);
/// The cost of a frame in numbers that do not depend on the machine.
[[nodiscard]] BenchCommand counts_command(CommandLine& app);
/// Displacement of the picture on a moving prop, with and without prediction.
[[nodiscard]] BenchCommand latency_command(CommandLine& app);
/// Which prop and projector suit a table.
[[nodiscard]] BenchCommand setup_command(CommandLine& app);
/// The cost of two eyes' pictures over that of one.
[[nodiscard]] BenchCommand stereo_command(CommandLine& app);
/// Which cells are polygons and which are reliefs: our choice against the paper's, on one walk.
[[nodiscard]] BenchCommand mixed_command(CommandLine& app);
/// The room behind the screen, of many objects, against other ways to draw it.
[[nodiscard]] BenchCommand room_command(CommandLine& app);
/// A torch's light: ours against the paper's.
[[nodiscard]] BenchCommand torch_command(CommandLine& app);
/// Frozen windows: ours against the multi-LDI report's and peers.
[[nodiscard]] BenchCommand ldi_command(CommandLine& app);
/// A pack's cells at rest against the whole.
[[nodiscard]] BenchCommand cells_command(CommandLine& app);
/// The benefit of advice for visitors.
[[nodiscard]] BenchCommand guidance_command(CommandLine& app);
/// The benefit of the recovery ladder over years of faults.
[[nodiscard]] BenchCommand ladder_command(CommandLine& app);

} // namespace frustumscreen::programs
