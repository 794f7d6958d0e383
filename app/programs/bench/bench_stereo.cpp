#include "app/bench/setup/stereo_cost.h"
#include "app/pack/pack_file.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config = "config/kiosk.toml";
    std::filesystem::path pack;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(arguments.config));
    TRY(const pack::VerifiedPack pack, pack::load_pack(arguments.pack));
    TRY(const std::vector<bench::StereoCost> costs,
        bench::stereo_costs(*settings, *pack, [&progress](double done) { progress.show("frames", done); }));
    progress.clear();
    fmt::print("{}", bench::stereo_table(costs));
    std::fflush(stdout);
    return write_all(arguments.out, {{"stereo.csv", bench::stereo_csv(costs)}});
}

} // namespace

BenchCommand stereo_command(CommandLine& app) {
    CommandLine command =
        app.add_subcommand("stereo", "times frames with a picture for each eye against frames with one");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--config", arguments->config, "settings of the table and its projector")
        .capture_default_str();
    command.add_option("--pack", arguments->pack, "pack whose frames are timed").required();
    command.add_option("--out", arguments->out, "folder for the table").required();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
