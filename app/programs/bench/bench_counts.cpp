#include "app/bench/measures/counts.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    std::vector<std::filesystem::path> packs;
    std::filesystem::path reference;
    int poses = 50;
    std::uint64_t seed = 1;
};

Result<std::vector<bench::CountedPack>> count_all(const Arguments& arguments, BenchProgress& progress) {
    TRY(const std::vector<bench::SetUp> set_ups, load_set_ups(arguments.place));
    std::vector<bench::CountedPack> counted;
    for (const std::filesystem::path& file : arguments.packs) {
        progress.show(file.filename().string(),
                      static_cast<double>(counted.size()) /
                          static_cast<double>(arguments.packs.size() * set_ups.size()));
        TRY(const pack::VerifiedPack pack, pack::load_pack(file));
        for (const bench::SetUp& set_up : set_ups) {
            TRY(bench::CountedPack one, bench::count_frames(set_up, *pack, arguments.poses, arguments.seed));
            counted.push_back(std::move(one));
        }
    }
    progress.clear();
    return counted;
}

Result<std::vector<bench::CountedPack>> load_reference(const std::filesystem::path& file) {
    if (file.empty()) {
        return std::vector<bench::CountedPack>{};
    }
    TRY(const Bytes bytes, read_file(file));
    return at(file.string(), bench::read_counts(as_text(bytes)));
}

/// An artifact that the reference lacks is an error too, because its counts would not be checked.
Result<void> require_reference(std::span<const bench::CountedPack> counted,
                               std::span<const bench::CountedPack> reference,
                               std::span<const bench::CountChange> against,
                               const std::filesystem::path& file) {
    if (std::any_of(against.begin(), against.end(),
                    [](const bench::CountChange& one) { return one.grown; })) {
        return fail(ErrorKind::Internal, "bench.counts_grew", "a frame takes over {:.0f} % more than {} says",
                    100.0 * (bench::max_count_growth - 1.0), file.string());
    }
    if (const std::vector<std::string> lacking = bench::without_reference(counted, reference);
        !lacking.empty()) {
        return bad_input("bench.counts_lacking",
                         "{} lacks {}; compare with a file that has them, or add them from counts.json",
                         file.string(), fmt::join(lacking, "; "));
    }
    return {};
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    TRY(const std::vector<bench::CountedPack> reference, load_reference(arguments.reference));
    TRY(const std::vector<bench::CountedPack> counted, count_all(arguments, progress));
    const std::vector<bench::CountChange> against = bench::changes(counted, reference);
    fmt::print("{}", bench::counts_table(counted, against));
    std::fflush(stdout);
    TRY_VOID(write_all(arguments.place.out, {{"counts.json", bench::counts_json(counted)}}));
    if (!arguments.reference.empty()) {
        return require_reference(counted, reference, against, arguments.reference);
    }
    return {};
}

} // namespace

BenchCommand counts_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "counts", "counts triangles, samples and bytes of a frame, and their change against a reference");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    command.add_option("--pack", arguments->packs, "one or several packs").required();
    command.add_option("--reference", arguments->reference,
                       "counts.json to compare with, such as docs/reference_counts.json");
    add_pose_options(command, arguments->poses, arguments->seed);
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
