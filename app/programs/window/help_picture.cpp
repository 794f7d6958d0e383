#include "app/programs/window/help_picture.h"

#include "app/typography/canvas.h"

#include <array>
#include <cstring>
#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr std::array<std::pair<const char*, const char*>, 8> lines{{
    {"left half", "the projector's picture"},
    {"right half", "what the visitor's eye sees"},
    {"drag", "slide the prop, in either half"},
    {"wheel, right drag", "turn the prop"},
    {"middle drag", "move the visitor's eye"},
    {"1 to 7", "buttons: previous, next, language, choose, help, behaviour, window"},
    {"H", "this help"},
    {"Esc", "end"},
}};
constexpr int width = 640;
constexpr int margin = 24;
constexpr int pitch = 27;
constexpr int second_column = 180;
constexpr double em_px = 15.0;
constexpr typography::Colour background{20, 22, 26};
constexpr typography::Colour quiet{150, 196, 200};
constexpr typography::Colour bright{236, 236, 232};

} // namespace

Result<window::WindowHelp> help_picture() {
    TRY(const typography::Typesetter typesetter, typography::Typesetter::open());
    typography::Canvas canvas(width, 2 * margin + pitch * static_cast<int>(lines.size()), background);
    double y = margin;
    for (const auto& [key, meaning] : lines) {
        canvas.text(typesetter, key, {margin, y}, em_px, quiet, {}, true);
        canvas.text(typesetter, meaning, {second_column, y}, em_px, bright);
        y += pitch;
    }
    const image::Image8 image = canvas.take();
    window::WindowHelp help{{image.width, image.height}, std::vector<std::uint8_t>(4 * image.texels.size())};
    std::memcpy(help.rgba.data(), image.texels.data(), help.rgba.size());
    return help;
}

} // namespace frustumscreen::programs
