/// frustumscreen-bench: measurements as tables and plots; each command has its own file.
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <array>

namespace frustumscreen::programs {
namespace {

int run(int argc, char** argv) {
    CommandLine app("Measures the exhibit: picture, frame times, numerical stability, latency, guidance, "
                    "recovery, tags and cameras. Also finds the set-up that suits a table.",
                    "frustumscreen-bench");
    app.set_version_flag("--version", name_and_version("frustumscreen-bench"));
    app.require_subcommand();
    const std::array commands = {error_time_command(app), scaling_command(app),   projection_command(app),
                                 shimmer_command(app),    stability_command(app), plot_command(app),
                                 counts_command(app),     latency_command(app),   setup_command(app),
                                 guidance_command(app),   ladder_command(app),    estimate_command(app),
                                 tags_command(app),       visitor_command(app),   stereo_command(app),
                                 mixed_command(app),      room_command(app),      cells_command(app),
                                 report_command(app),     torch_command(app),     ldi_command(app)};
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    for (const BenchCommand& command : commands) {
        if (!command.options.parsed()) {
            continue;
        }
        BenchProgress progress;
        const Result<void> done = command.run(progress);
        if (!done) {
            progress.clear();
            complain("frustumscreen-bench", done.error());
            return 1;
        }
    }
    return 0;
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-bench", frustumscreen::programs::run, argc,
                                                 argv);
}
