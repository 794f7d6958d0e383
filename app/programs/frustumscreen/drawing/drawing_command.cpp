#include "app/programs/frustumscreen/drawing/drawing_command.h"

#include "app/drawing/drawing.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/drawing/room_objects.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path config;
    std::filesystem::path output;
    std::string sheet = "table";
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Draws what is to be built, from the settings: SVG, to scale, lengths in mm.",
                    "frustumscreen drawing");
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("-o,--output", request.output, "SVG file to write").required();
    app.add_option("--sheet", request.sheet,
                   "table: A3 with table, projector and eyes (the default); prop: A3 with the prop's views "
                   "and unfolded faces; net: the unfolded faces in true size, to cut out; holder: A3 with a "
                   "plate that the prop rests in; torch: A3 with a torch and its holder; room: A3 with the "
                   "screen and the "
                   "room behind it")
        .one_of({"table", "prop", "net", "holder", "torch", "room"});
    return app.end_of_arguments(argc, argv);
}

Result<void> draw(const Request& request) {
    const std::array inputs{request.config};
    TRY_VOID(check_output_is_no_input(request.output, inputs));
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    TRY_VOID(check_output_place(request.output));
    const std::string name = request.config.filename().string();
    if (request.sheet == "room") {
        if (!settings->screen.exists()) {
            return bad_input("drawing.no_screen",
                             "--sheet room: the settings have no screen; add a table [screen] with its room");
        }
        TRY(const std::vector<drawing::DrawnObject> objects, drawn_objects(settings->screen.room));
        return write_file(request.output, as_bytes(drawing::room_sheet(*settings, objects, name)));
    }
    const std::string drawing = request.sheet == "table"    ? drawing::table_sheet(*settings, name)
                                : request.sheet == "prop"   ? drawing::prop_sheet(*settings, name)
                                : request.sheet == "holder" ? drawing::holder_sheet(*settings, name)
                                : request.sheet == "torch"  ? drawing::torch_sheet(*settings, name)
                                                            : drawing::net_sheet(*settings, name);
    return write_file(request.output, as_bytes(drawing));
}

} // namespace

int drawing_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    return exit_status("frustumscreen", draw(request));
}

} // namespace frustumscreen::programs
