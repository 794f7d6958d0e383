#include "app/programs/calibrate/sheet_command.h"

#include "app/drawing/board/board_sheet.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/output_file.h"

#include <array>

namespace frustumscreen::programs {

namespace {

Result<int> draw(const CalibrateRequest& request) {
    const std::array inputs{request.config};
    TRY_VOID(check_output_is_no_input(request.out, inputs));
    TRY(const Described described, describe(request));
    TRY(const calibration::Board board, board_of(*described.settings));
    return write_file(request.out, as_bytes(drawing::board_sheet(board, request.config.filename().string())))
        .map([] { return 0; });
}

} // namespace

Result<calibration::Board> board_of(const settings::Settings& settings) {
    const settings::PropSettings& prop = settings.prop;
    TRY_VOID(check_square_foot(prop));
    return calibration::board_for(prop.kind == settings::PropKind::Cube
                                      ? geometry::FrustumSize{prop.base_m, prop.base_m, prop.base_m}
                                      : geometry::FrustumSize{prop.base_m, prop.top_m, prop.height_m});
}

void add_sheet_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command = app.add_subcommand(
        "sheet", "draws the sheet of tags that auto needs, for the settings' prop: A3, true size, SVG");
    command.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    command.add_option("-o,--output", request.out, "SVG file to write").required();
    command.callback([&] { chosen = [&] { return end_with(draw(request)); }; });
}

} // namespace frustumscreen::programs
