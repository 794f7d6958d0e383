/// frustumscreen: the exhibit and its tools; dispatches to the command named first.
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/camera/camera_command.h"
#include "app/programs/frustumscreen/config/config_command.h"
#include "app/programs/frustumscreen/counts/counts_command.h"
#include "app/programs/frustumscreen/drawing/drawing_command.h"
#include "app/programs/frustumscreen/guide/guide_command.h"
#include "app/programs/frustumscreen/plan/plan_command.h"
#include "app/programs/frustumscreen/record/record_command.h"
#include "app/programs/frustumscreen/render/render_command.h"
#include "app/programs/frustumscreen/report/report_command.h"
#include "app/programs/frustumscreen/run_command.h"
#include "app/programs/frustumscreen/states/states_command.h"
#include "app/programs/frustumscreen/status/status_command.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {
namespace {

void print_usage(std::FILE* to) {
    fmt::print(to,
               "usage: frustumscreen "
               "run|status|counts|report|record|camera|render|guide|states|plan|config|drawing [--help] ...\n"
               "  run     runs the exhibit\n"
               "  status  prints the exhibit's status; saves its picture\n"
               "  counts  prints how often, when and for how long it is used\n"
               "  report  collects status, journal, faults, visits and settings into a folder\n"
               "  record  writes what the tracker sends to a file\n"
               "  camera  lists cameras and checks the one in the settings\n"
               "  render  draws the pictures of a pose file, without devices\n"
               "  guide   lists for each pose the seen faces that are not lit, and the move that helps\n"
               "  states  prints the table of the exhibit's states and events\n"
               "  plan    lists what a scene loads, what it leaves out, and what that saves\n"
               "  config  prints the checked settings, or explains them\n"
               "  drawing draws table, projector and prop to scale, to build them\n"
               "  --version prints the version\n");
}

struct Command {
    std::string_view name;
    int (*run)(int argc, char** argv);
};
constexpr std::array<Command, 12> commands{{{"run", run_command},
                                            {"status", status_command},
                                            {"counts", counts_command},
                                            {"report", report_command},
                                            {"record", record_command},
                                            {"camera", camera_command},
                                            {"render", render_command},
                                            {"guide", guide_command},
                                            {"states", states_command},
                                            {"plan", plan_command},
                                            {"config", config_command},
                                            {"drawing", drawing_command}}};

const Command* command_named(std::string_view name) {
    const auto* const found = std::find_if(commands.begin(), commands.end(),
                                           [&](const Command& command) { return command.name == name; });
    return found != commands.end() ? found : nullptr;
}

int dispatch(int argc, char** argv) {
    const std::vector<std::string_view> words(argv + std::min(argc, 1), argv + argc);
    const std::string_view first = words.empty() ? "" : words[0];
    const Command* const command = command_named(first);
    if (first == "--version" || (command != nullptr && words.size() == 2 && words[1] == "--version")) {
        fmt::print("frustumscreen {}\n", project_version());
        return 0;
    }
    if (command != nullptr) {
        return command->run(argc - 1, argv + 1);
    }
    if (first == "--help" || first == "-h") {
        print_usage(stdout);
        return 0;
    }
    if (const auto late = std::find_if(words.begin(), words.end(), command_named); late != words.end()) {
        fmt::print(stderr, "frustumscreen: write {} before its options\n", *late);
        return 2;
    }
    print_usage(stderr);
    return 2;
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen", frustumscreen::programs::dispatch, argc,
                                                 argv);
}
