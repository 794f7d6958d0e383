#include "app/programs/bench/bench_command.h"

#include "app/bench/plots/draw_tables.h"
#include "app/pack/container/sha256.h"
#include "app/pack/pack_file.h"
#include "app/programs/common/command_line.h"
#include "app/settings/settings.h"
#include "assets_baked/bake/load_mesh.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/format.h>

#include <cstdio>

namespace frustumscreen::programs {

void BenchProgress::show(const std::string& step, double done) {
    const double passed_s = to_seconds(monotonic_now() - started_);
    const std::optional<double> left_s = time_left_.update(step, done, passed_s);
    line_.say(fmt::format("{} {:.0f} %{}", step, done * 100.0,
                          left_s ? fmt::format(", {} left", words_of_time(*left_s)) : std::string()));
}

void add_place_options(CommandLine& command, BenchPlace& place) {
    command.add_option("--out", place.out, "folder for the tables and plots").required();
    command.add_option(
        "--config", place.configs,
        "settings of a set-up; may be repeated (default: config/near.toml, config/kiosk.toml)");
}

void add_picture_options(CommandLine& command, bench::PictureOptions& picture) {
    command.add_option("--samples", picture.samples, "samples per pixel; 0: as many as the pack asks for")
        .one_of_numbers({0, 1, 2, 4, 8, 16})
        .capture_default_str();
}

void add_pose_options(CommandLine& command, int& poses, std::uint64_t& seed) {
    command.add_option("--poses", poses, "number of random poses of prop and eye")
        .within(1, 10000)
        .capture_default_str();
    command.add_option("--seed", seed, "seed of the random poses").capture_default_str();
}

void add_artifact_options(CommandLine& command, BenchArtifact& artifact) {
    command.add_option("--pack", artifact.pack, "pack to measure").required();
    command.add_option("--mesh", artifact.mesh, "file that the pack was baked from").required();
}

namespace {

void warn(const std::filesystem::path& file, const std::string& of_what) {
    fmt::print(stderr, "frustumscreen-bench: {}: {}\n", file.string(), of_what);
}

} // namespace

Result<LoadedArtifact> load_artifact(const BenchArtifact& artifact) {
    TRY(pack::VerifiedPack pack, pack::load_pack(artifact.pack));
    TRY(const Bytes bytes, read_file(artifact.mesh));
    if (pack::sha256_hex(bytes) != pack->provenance.source_sha256) {
        warn(artifact.mesh,
             fmt::format(
                 "not the file that {} was baked from (that was {}); the errors are valid only if both have "
                 "the same surface",
                 artifact.pack.string(), pack->provenance.source_name));
    }
    TRY(bake::SourceMesh mesh, bake::load_mesh(artifact.mesh));
    return LoadedArtifact{std::move(pack), std::make_shared<const bake::SourceMesh>(std::move(mesh))};
}

Result<std::vector<bench::SetUp>> load_set_ups(const BenchPlace& place) {
    std::vector<std::filesystem::path> configs = place.configs;
    if (configs.empty()) {
        configs = {"config/near.toml", "config/kiosk.toml"};
    }
    std::vector<bench::SetUp> set_ups;
    for (const std::filesystem::path& config : configs) {
        TRY(const settings::CheckedSettings settings, settings::load_settings(config));
        set_ups.push_back({config.stem().string(), *settings});
    }
    return set_ups;
}

Result<void> write_all(const std::filesystem::path& folder, const OutputFiles& files) {
    std::error_code made;
    std::filesystem::create_directories(folder, made);
    if (made) {
        return bad_input("bench.no_folder",
                         folder.string() + ": this folder cannot be made: " + made.message());
    }
    for (const auto& [name, text] : files) {
        TRY_VOID(write_file(folder / name, as_bytes(text)));
    }
    return {};
}

Result<void> draw_all(const std::filesystem::path& folder, const std::vector<std::string>& tables) {
    std::vector<std::string> paths;
    for (const std::string& table : tables) {
        paths.push_back((folder / table).string());
    }
    return bench::draw_tables(bench::plot_script(), paths);
}

} // namespace frustumscreen::programs
