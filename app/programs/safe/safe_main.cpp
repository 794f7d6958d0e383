/// frustumscreen-safe: a calm picture with words for visitors and staff, for times when the exhibit itself
/// cannot run.
#include "app/image/image.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/safe/show_safe_picture.h"
#include "app/safe/eye_halves.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

constexpr int min_side = 320, max_side = 8192;

struct Size {
    int width = 1920, height = 1080;
};

std::string read_size(const std::string& text, Size& size) {
    const char* const end = text.data() + text.size();
    const std::from_chars_result width = std::from_chars(text.data(), end, size.width);
    bool good = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
    if (good) {
        const std::from_chars_result height = std::from_chars(width.ptr + 1, end, size.height);
        good = height.ec == std::errc{} && height.ptr == end;
    }
    good = good && std::min(size.width, size.height) >= min_side &&
           std::max(size.width, size.height) <= max_side;
    return good ? std::string()
                : fmt::format("'{}' is not a size; allowed are {} to {} pixels a side, such as 1280x800",
                              text, min_side, max_side);
}

Result<void> write_picture(const std::string& file, const Size& size, const SafeArguments& arguments) {
    const safe::SafeText text{read_reason(arguments.reason), {}};
    const safe::SafePage page = safe::lay_out_safe_page(size.width, size.height, text, arguments.languages);
    std::vector<std::uint8_t> greys(static_cast<std::size_t>(size.width) *
                                    static_cast<std::size_t>(size.height));
    safe::draw_rows_for_eyes(page, read_halves(arguments.stereo), 0, greys);
    image::Image8 picture(size.width, size.height);
    std::transform(greys.begin(), greys.end(), picture.texels.begin(),
                   [](std::uint8_t grey) { return glm::u8vec4(grey, grey, grey, 255); });
    return write_file(file, image::encode_png(picture));
}

int run(int argc, char** argv) {
    CommandLine app("Tells visitors in all languages that the exhibit is out of order, and the staff why and "
                    "what to do. Needs only the graphics card's driver: no settings, no packs, no OpenGL.",
                    "frustumscreen-safe");
    app.set_version_flag("--version", name_and_version("frustumscreen-safe"));
    SafeArguments arguments;
    arguments.languages = safe::safe_languages();
    std::string png;
    Size size;
    std::string size_text;
    std::vector<std::string> languages;
    app.add_option("--card", arguments.card,
                   "graphics card, such as /dev/dri/card0 (default: the first with a projector)");
    app.add_option("--reason", arguments.reason,
                   "file whose first line is shown to the staff; read once a second");
    app.add_option("--alive", arguments.alive,
                   "file to rewrite after each shown picture: their number, and CLOCK_MONOTONIC in ns");
    app.add_option("--stereo", arguments.stereo,
                   "file with the projector's stereo layout, as in the settings; read at the start. In "
                   "\"side_by_side\" and \"top_bottom\" each half of the picture has all words");
    app.add_option("--language", languages,
                   "languages for visitors, the first also for the staff (default: all)")
        .one_of({arguments.languages.begin(), arguments.languages.end()});
    const CommandOption out = app.add_option(
        "--png", png, "draw the picture into this PNG file and end; no graphics card is needed");
    app.add_option("--size", size_text, "size of that picture, pixels, such as 1280x800 (default: 1920x1080)")
        .needs(out)
        .check({[&size](const std::string& text) { return read_size(text, size); }, ""});
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    if (!languages.empty()) {
        arguments.languages.assign(languages.begin(), languages.end());
    }
    return exit_status("frustumscreen-safe",
                       png.empty() ? show_safe_picture(arguments) : write_picture(png, size, arguments));
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-safe", frustumscreen::programs::run, argc,
                                                 argv);
}
