/// frustumscreen-calibrate: computes a table's projector and tracker from touched or measured points.
#include "app/programs/calibrate/auto_command.h"
#include "app/programs/calibrate/corners_command.h"
#include "app/programs/calibrate/eye_command.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/sheet_command.h"
#include "app/programs/calibrate/table_command.h"
#include "app/programs/calibrate/touch_command.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "firmware_host/base/version.h"

namespace frustumscreen::programs {
namespace {

int run(int argc, char** argv) {
    CommandLine app("Calibrates a table: finds the poses of projector and tracker. table, auto and eye work "
                    "on the table; touch, auto, corners and eye also compute from a file of points.",
                    "frustumscreen-calibrate");
    app.set_version_flag("--version", name_and_version("frustumscreen-calibrate"));
    app.require_subcommand();
    app.footer("Exit status: 0 the calibration is good or usable; 1 points must be repeated or are unusable "
               "(--json prints the verdict all the same); 2 wrong arguments.");
    CalibrateRequest request;
    std::function<int()> chosen;
    add_touch_command(app, request, chosen);
    add_auto_command(app, request, chosen);
    add_corners_command(app, request, chosen);
    add_table_command(app, request, chosen);
    add_eye_command(app, request, chosen);
    add_sheet_command(app, request, chosen);
    add_kept_command(app, request, chosen);
    if (const auto end = app.end_of_arguments(argc, argv, [&] { check_request(request); })) {
        return *end;
    }
    return chosen();
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-calibrate", frustumscreen::programs::run,
                                                 argc, argv);
}
