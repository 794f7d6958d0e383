#include "app/bench/room/room_bench.h"
#include "app/pack/pack_file.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "app/render/read_back.h"
#include "firmware_host/base/file.h"

#include <algorithm>
#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path packs; ///< of an earlier run; empty: they are baked
    std::filesystem::path config = "config/near.toml";
    bench::RoomOptions options;
    int objects = 200;
    std::int64_t triangles = 24'000; ///< of each artifact
    int width = 1280, height = 720;
    int size = 192; ///< of the packs
    std::uint64_t seed = 1;
    bool is_long = false;
};

/// The meshes are made again in each run; packs of an earlier run must be of them.
Result<std::vector<bench::RoomSource>> make_sources(const Arguments& arguments, BenchProgress& progress) {
    TRY(std::vector<bench::RoomPiece> pieces, bench::make_room_pieces(arguments.triangles));
    std::vector<bench::RoomSource> sources;
    for (bench::RoomPiece& piece : pieces) {
        const bool is_baked = !arguments.packs.empty();
        const std::filesystem::path file =
            (is_baked ? arguments.packs : arguments.out) / (piece.name + ".fspack");
        if (is_baked) {
            TRY(const pack::VerifiedPack pack, pack::load_pack(file));
            if (pack->provenance.source_triangles != piece.mesh.triangles.size()) {
                return bad_input(
                    "bench.other_pieces",
                    "{}: it was baked of {} triangles, this run has {}; give --triangles as in the run "
                    "that baked it, or leave out --packs",
                    file.string(), pack->provenance.source_triangles, piece.mesh.triangles.size());
            }
        } else {
            progress.show("the room's packs",
                          static_cast<double>(sources.size()) / static_cast<double>(pieces.size()));
            TRY_VOID(bench::bake_piece(piece, file, arguments.size));
        }
        sources.push_back(
            {piece.name, piece.use, std::make_shared<const bake::SourceMesh>(std::move(piece.mesh)), file});
    }
    return sources;
}

/// How long each step of a run took.
class StepTimes {
public:
    void begin(const std::string& step) {
        if (begun_.empty() || begun_.back().first != step) {
            begun_.emplace_back(step, monotonic_now());
        }
    }
    /// One line; the last step ends now.
    [[nodiscard]] std::string line() const {
        const MonotonicTime now = monotonic_now();
        std::string words;
        for (std::size_t k = 0; k < begun_.size(); ++k) {
            const MonotonicTime end = k + 1 < begun_.size() ? begun_[k + 1].second : now;
            words += fmt::format(", {} {:.0f} s", begun_[k].first, to_seconds(end - begun_[k].second));
        }
        return fmt::format("{:.0f} s{}\n", begun_.empty() ? 0.0 : to_seconds(now - begun_.front().second),
                           words);
    }

private:
    std::vector<std::pair<std::string, MonotonicTime>> begun_;
};

/// By these, `frustumscreen render --output screen` draws the same room on the same walks.
OutputFiles files_to_render(const Arguments& arguments, const room::Room& room,
                            const std::vector<bench::RoomWalk>& walks) {
    OutputFiles files{{"room.toml", bench::room_toml(room)},
                      {"settings.toml", fmt::format("[display]\nkind = \"surfaceless\"\n\n[screen]\nroom = "
                                                    "\"room.toml\"\nwidth = {}\nheight = {}\n",
                                                    arguments.width, arguments.height)}};
    for (const bench::RoomWalk& walk : walks) {
        std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (const bench::RoomFrame& frame : walk.frames) {
            const glm::dvec3& eye_m = frame.eye_m;
            poses += fmt::format("{0:.0f},1,0,0,0,1,0,0,0,1\n{0:.0f},2,{1},{2},{3},1,0,0,0,1\n",
                                 1e6 * frame.seconds, eye_m.x, eye_m.y, eye_m.z);
        }
        files.emplace_back("poses_" + walk.name + ".csv", std::move(poses));
    }
    return files;
}

/// The picture in the middle of each walk.
Result<void> write_pictures(bench::RoomSet& set, const std::vector<bench::RoomWalk>& walks,
                            const std::filesystem::path& folder) {
    TRY(const std::unique_ptr<bench::RoomTechnique> ours, bench::make_room_ours(set));
    for (const bench::RoomWalk& walk : walks) {
        const std::size_t middle = walk.frames.size() / 2;
        for (std::size_t frame = middle - std::min<std::size_t>(middle, 10); frame <= middle; ++frame) {
            ours->draw(walk.frames[frame]);
        }
        const settings::ScreenSettings& screen = set.settings().screen;
        TRY_VOID(write_file(
            folder / ("room_walk_" + walk.name + ".png"),
            image::encode_png(render::read_colour(set.target().framebuffer, screen.width, screen.height))));
    }
    return {};
}

Result<void> run(Arguments arguments, BenchProgress& progress) {
    if (arguments.is_long) {
        arguments.options.frames = static_cast<int>(600.0 * bench::room_walk_hz);
        arguments.options.peer_every = 20;
        arguments.options.errors = 12;
        arguments.triangles = 140'000; // 20 million with all objects
    }
    StepTimes times;
    times.begin("the room's packs");
    TRY(const settings::CheckedSettings checked, settings::load_settings(arguments.config));
    settings::Settings settings = *checked;
    TRY_VOID(write_all(arguments.out, {}));
    TRY(std::vector<bench::RoomSource> sources, make_sources(arguments, progress));
    const room::Room room = bench::make_room(sources, arguments.objects, arguments.seed);
    settings.screen = {.room = sources.front().pack.parent_path() / "room.toml",
                       .width = arguments.width,
                       .height = arguments.height};
    const std::vector<bench::RoomWalk> walks = bench::room_walks(settings.screen, arguments.options.frames);
    TRY_VOID(write_all(sources.front().pack.parent_path(), files_to_render(arguments, room, walks)));
    TRY(const std::unique_ptr<bench::RoomSet> set,
        bench::RoomSet::open(settings, room, std::move(sources), {}));
    TRY(const bench::RoomResult result,
        bench::measure_room(*set, walks, arguments.options, [&](const std::string& step, double done) {
            times.begin(step);
            progress.show(step, done);
        }));
    progress.clear();
    fmt::print("{}{}{}", bench::room_table(result), bench::room_verdicts(result), times.line());
    TRY_VOID(write_all(arguments.out, {{"room.csv", bench::room_csv(result)},
                                       {"room_frames.csv", bench::room_frames_csv(result)},
                                       {"room_paper.csv", bench::room_paper_csv(result)}}));
    TRY_VOID(write_pictures(*set, walks, arguments.out));
    return draw_all(arguments.out, {"room.csv", "room_frames.csv", "room_paper.csv"});
}

} // namespace

BenchCommand room_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "room", "measures the room behind the screen, of many objects, against fixed polygons, fixed "
                "relief, meshoptimizer's levels and the paper's choice");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the packs, tables and plots").required();
    command.add_option("--packs", arguments->packs, "folder of an earlier run whose packs are used again");
    command.add_option("--config", arguments->config, "settings of the set-up").capture_default_str();
    command
        .add_option("--objects", arguments->objects,
                    "number of objects in the room, floor and walls included")
        .within(bench::min_room_objects, static_cast<int>(room::max_objects))
        .capture_default_str();
    command.add_option("--triangles", arguments->triangles, "triangles of each artifact's source")
        .within(1000, 10'000'000)
        .capture_default_str();
    command.add_option("--frames", arguments->options.frames, "length of each walk, at 10 frames a second")
        .within(2, 100000)
        .capture_default_str();
    command
        .add_option("--passes", arguments->options.passes,
                    "passes over the walks; the least time of each frame counts")
        .within(1, 100)
        .capture_default_str();
    command.add_option("--width", arguments->width, "width of the picture, pixels")
        .within(64, 8192)
        .capture_default_str();
    command.add_option("--height", arguments->height, "height of the picture, pixels")
        .within(64, 8192)
        .capture_default_str();
    command
        .add_option("--size", arguments->size,
                    "texels along the longest edge of a face, as frustumscreen-bake --size")
        .within(16, 4096)
        .capture_default_str();
    command.add_option("--seed", arguments->seed, "seed of the room").capture_default_str();
    command.add_flag("--long", arguments->is_long, "walks of ten minutes, 20 million source triangles");
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
