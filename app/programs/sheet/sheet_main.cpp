/// frustumscreen-sheet: makes pictures for people, only from the projector's pictures, their poses and the
/// settings.
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "app/programs/sheet/room_picture.h"
#include "app/programs/sheet/sheet_animation.h"
#include "app/programs/sheet/sheet_frames.h"
#include "app/programs/sheet/sheet_picture.h"
#include "app/programs/sheet/sheet_table.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

struct Request {
    std::filesystem::path config;
    std::vector<std::filesystem::path> folders;
    std::vector<std::filesystem::path> poses;
    std::vector<std::string> labels;
    std::filesystem::path sheet;
    std::filesystem::path animation;
    std::filesystem::path room;
    std::filesystem::path table;
    std::size_t rows = 8;
    std::size_t animation_frames = 64;
    SheetOptions sheet_options;
    AnimationOptions animation_options;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Makes a contact sheet, an animation and a table of frame times from the pictures of "
                    "'frustumscreen run' or 'render'.",
                    "frustumscreen-sheet");
    app.set_version_flag("--version", name_and_version("frustumscreen-sheet"));
    app.add_option("--config", request.config, "settings of these pictures, TOML").required();
    app.add_option("--frames", request.folders, "folders of pictures, frame_00000.png ...").required();
    app.add_option("--poses", request.poses, "pose file of each folder (default: its poses.csv)");
    app.add_option("--label", request.labels,
                   "label of each folder (default: the artifact in its frames.csv)");
    app.add_option("-o,--output", request.sheet,
                   "contact sheet to write: PNG, with the projector's picture and the visitor's view");
    app.add_option("--rows", request.rows, "number of frames of each folder on the sheet")
        .within(1, 64)
        .capture_default_str();
    app.add_option("--columns", request.sheet_options.columns,
                   "number of frames next to each other (default: 1 or 2)")
        .within(1, 4);
    app.add_flag("--whole-table", request.sheet_options.whole_table,
                 "show the whole table with its words instead of the prop alone");
    app.add_option("--title", request.sheet_options.title, "title of the sheet and the table")
        .capture_default_str();
    app.add_option("--animation", request.animation, "animation of the first folder to write: WebP");
    app.add_option("--animation-frames", request.animation_frames, "largest number of pictures each way")
        .within(2, 600)
        .capture_default_str();
    app.add_flag("--closed", request.animation_options.closed,
                 "play forwards only, because the last picture leads to the first");
    app.add_flag("--lossless", request.animation_options.lossless,
                 "compress the animation without loss; the file is several times as large");
    app.add_option("--width", request.animation_options.width, "width of the animation, pixels")
        .within(16, 4096)
        .capture_default_str();
    app.add_option("--height", request.animation_options.height, "height of the animation, pixels")
        .within(16, 4096)
        .capture_default_str();
    app.add_option("--room", request.room,
                   "PNG of the first frame to write: table in its room, projector's picture, visitor's view");
    app.add_option("--table", request.table, "table of frame times and errors to write: .html or .md");
    return app.end_of_arguments(argc, argv, [&] {
        if (request.sheet.empty() && request.animation.empty() && request.room.empty() &&
            request.table.empty()) {
            throw WrongUse{"nothing to make; give -o, --animation, --room or --table"};
        }
        if (request.poses.size() > request.folders.size() || request.labels.size() > request.folders.size()) {
            throw WrongUse{"more --poses or --label than --frames"};
        }
    });
}

Result<void> draw_sheet(const Request& request, const settings::Settings& settings,
                        const std::vector<FrameFolder>& folders) {
    if (request.sheet.empty()) {
        return {};
    }
    TRY(const typography::Typesetter typesetter, typography::Typesetter::open());
    std::vector<SheetFrame> frames;
    for (const FrameFolder& folder : folders) {
        const std::vector<SheetFrame> chosen = evenly(distinct(folder.frames), request.rows);
        frames.insert(frames.end(), chosen.begin(), chosen.end());
    }
    ProgressLine progress("contact sheet");
    TRY(const image::Image8 sheet,
        contact_sheet(settings, frames, request.sheet_options, typesetter,
                      [&](std::size_t done, std::size_t all) { progress.show(done, all); }));
    return write_file(request.sheet, image::encode_png(sheet));
}

Result<void> draw_room(const Request& request, const settings::Settings& settings, const SheetFrame& frame) {
    if (request.room.empty()) {
        return {};
    }
    TRY(const typography::Typesetter typesetter, typography::Typesetter::open());
    TRY(const image::Image8 picture, room_picture(settings, frame, typesetter));
    return write_file(request.room, image::encode_png(picture));
}

Result<void> draw_animation(const Request& request, const settings::Settings& settings,
                            const FrameFolder& folder) {
    if (request.animation.empty()) {
        return {};
    }
    ProgressLine progress("animation");
    TRY(const Bytes animation,
        visitor_animation(settings, evenly(folder.frames, request.animation_frames),
                          request.animation_options,
                          [&](std::size_t done, std::size_t all) { progress.show(done, all); }));
    return write_file(request.animation, animation);
}

Result<void> make(const Request& request) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    std::vector<FrameFolder> folders;
    for (std::size_t k = 0; k < request.folders.size(); ++k) {
        TRY(FrameFolder folder,
            read_frame_folder(request.folders[k], k < request.poses.size() ? request.poses[k] : "",
                              k < request.labels.size() ? request.labels[k] : "", settings->eye.default_m));
        folders.push_back(std::move(folder));
    }
    TRY_VOID(draw_sheet(request, *settings, folders));
    TRY_VOID(draw_room(request, *settings, folders.front().frames.front()));
    TRY_VOID(draw_animation(request, *settings, folders.front()));
    if (!request.table.empty()) {
        std::vector<FrameRecord> records;
        for (const FrameFolder& folder : folders) {
            records.insert(records.end(), folder.records.begin(), folder.records.end());
        }
        const std::vector<TableLine> lines = table_lines(records);
        const std::string text =
            request.table.extension() == ".md"
                ? markdown_table(lines)
                : html_table(lines, request.sheet_options.title + ": frame times and errors");
        return write_file(request.table, as_bytes(text));
    }
    return {};
}

int run(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    if (const Result<void> made = make(request); !made) {
        complain("frustumscreen-sheet", made.error());
        return 1;
    }
    return 0;
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-sheet", frustumscreen::programs::run, argc,
                                                 argv);
}
