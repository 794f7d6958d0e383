#include "app/show/staff_picture.h"

#include "app/show/qr_code.h"
#include "app/typography/canvas.h"
#include "app/typography/test_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr typography::Colour white{255, 255, 255};
constexpr typography::Colour lit_colour{255, 184, 92};
constexpr typography::Colour ring_colour{126, 158, 196};
constexpr double smallest_em_px = 8.0;

/// 1 px of a picture of 1280 x 800, scaled to the projector's.
double unit_px(const typography::PatternScene& scene) {
    return std::min(scene.projector.width / 1280.0, scene.projector.height / 800.0);
}

std::string circled(std::size_t button, const exhibit::StaffView& view) {
    constexpr std::array open{"\u2460", "\u2461", "\u2462", "\u2463", "\u2464", "\u2465", "\u2466"};
    constexpr std::array full{"\u2776", "\u2777", "\u2778", "\u2779", "\u277a", "\u277b", "\u277c"};
    return view.pressed == button ? full.at(button) : open.at(button);
}

/// The words of a page, from its title to the buttons' functions.
class PageWords {
public:
    PageWords(const exhibit::StaffView& view, const StaffFacts& facts) : view_(view), facts_(facts) {
        const auto page = static_cast<std::size_t>(view.page);
        add(fmt::format("{} of {}: {}", page + 1, exhibit::staff_page_names.size(),
                        exhibit::staff_page_names.at(page)),
            1.3, true);
        add_page();
        add_buttons();
        add_end();
    }
    /// Sets the words as large as fits the space, `em_px` at most.
    [[nodiscard]] image::Image<std::uint8_t> set(const typography::Typesetter& typesetter,
                                                 const glm::dvec2& space, double em_px) const {
        std::vector<typography::Paragraph> paragraphs;
        for (;; em_px *= 0.93) {
            paragraphs.clear();
            for (const Line& line : lines_) {
                paragraphs.push_back({.text = line.text,
                                      .em_px = em_px * line.size,
                                      .bold = line.bold,
                                      .brightness = 1.0,
                                      .space_before_px = em_px * line.space});
            }
            if (em_px <= smallest_em_px || typesetter.extent(paragraphs, space.x).y <= space.y) {
                return typesetter.set(paragraphs, space.x);
            }
        }
    }

private:
    struct Line {
        std::string text;
        double size = 1.0; ///< of the letters, in ems
        bool bold = false;
        double space = 0.3; ///< before the line, in ems
    };
    void add(std::string text, double size = 1.0, bool bold = false, double space = 0.3) {
        if (!text.empty()) {
            lines_.push_back({.text = std::move(text), .size = size, .bold = bold, .space = space});
        }
    }

    void add_page() {
        switch (view_.page) {
        case exhibit::StaffPage::Status:
            for (const std::string& line : facts_.lines) {
                add(line);
            }
            break;
        case exhibit::StaffPage::Place:
            add("The bright edge must lie on the table's edge, and the numbered edges on the prop's.");
            add_stereo();
            add(facts_.calibration);
            add(facts_.drift);
            break;
        case exhibit::StaffPage::Focus:
            add("Every star must be sharp to its middle, on paper held half as high as the prop.");
            break;
        case exhibit::StaffPage::Light:
            add_light();
            break;
        case exhibit::StaffPage::Sound:
            add_sound();
            break;
        case exhibit::StaffPage::Tracker:
            add(facts_.tracker);
            add_signal("prop", facts_.prop);
            if (facts_.tracks_head) {
                add_signal("head", facts_.head);
            }
            add("Let them lie still: noise is how much they trembled in the last second.");
            add(facts_.camera);
            break;
        case exhibit::StaffPage::Copy:
            add_copy();
            break;
        case exhibit::StaffPage::Buttons:
            add("Press each button: it lights up and is counted, and does nothing else here.");
            add(facts_.panel);
            break;
        }
    }

    void add_stereo() {
        if (facts_.stereo) {
            add("Put the glasses on: the left eye must see the L and no R, the right eye the R and no L.");
        }
        if (!facts_.measures_pixels) {
            add("The table cannot be measured in stereo. Set projector.stereo = \"off\", and switch 3D off "
                "in "
                "the projector's own menu.");
        }
    }

    void add_light() {
        switch (view_.light) {
        case exhibit::StaffLight::White:
            add("All white, for a lux meter. These words go after five seconds.");
            break;
        case exhibit::StaffLight::Black:
            add("All black, for a lux meter. These words go after five seconds.");
            break;
        case exhibit::StaffLight::Greys:
            add("Each step must be seen, also at both ends of the lower row.");
            break;
        }
    }

    void add_copy() {
        const exhibit::CopyState& copy = facts_.copy;
        if (!facts_.copies) {
            add("This exhibit writes to no stick. A technician makes copies in its shell.");
            return;
        }
        switch (copy.stage) {
        case exhibit::CopyStage::NoStick:
            add("Put in a stick that has an empty file frustumscreen-request.toml. For ten minutes settings, "
                "calibration, visits and packs can then be copied to it.");
            break;
        case exhibit::CopyStage::Looking:
            add("A stick is being checked.");
            break;
        case exhibit::CopyStage::NoRequest:
            add("The stick does not wait for a copy. Make an empty file frustumscreen-request.toml on it, "
                "without a signature, and put it in again.");
            break;
        case exhibit::CopyStage::Offered:
            add("The stick waits for a copy. Leave it in.");
            break;
        case exhibit::CopyStage::Writing:
            add(copy.percent > 0
                    ? fmt::format("The copy is being written, {} %. Leave the stick in.", copy.percent)
                    : "The copy is being written. Leave the stick in.");
            break;
        case exhibit::CopyStage::Written:
            add(fmt::format("The copy is written, in the folder {}. Take the stick out.", copy.said));
            add("Before another exhibit takes it, an office computer must sign it.");
            break;
        case exhibit::CopyStage::Failed:
            add(fmt::format("The copy is not written: {}", copy.said));
            break;
        }
    }

    void add_sound() {
        add(facts_.sound);
        if (!facts_.speaks) {
            add("This exhibit has nothing to say, so no loudspeaker is used.");
        }
        add(fmt::format("volume: {:+.1f} dB by the settings, {:+d} dB by these buttons: {:+.1f} dB",
                        facts_.settings_gain_db, view_.louder_db, facts_.settings_gain_db + view_.louder_db),
            1.15, true);
        add("It is kept until settings with another volume come.");
    }

    void add_signal(const char* sensor, const tracking::TrackerSignal& signal) {
        add(signal.rate_hz <= 0.0 ? fmt::format("{}: no samples arrive", sensor)
                                  : fmt::format("{}: {:.0f} samples a second, {:.0f} % of them can be used",
                                                sensor, signal.rate_hz, 100.0 * signal.usable),
            1.15, true);
        if (signal.noise_mm && signal.noise_deg) {
            add(fmt::format("{}: noise of {:.2f} mm and {:.3f}\u00b0", sensor, *signal.noise_mm,
                            *signal.noise_deg),
                1.15, true);
        }
    }

    [[nodiscard]] std::string action_of(std::size_t button) const {
        if (view_.page == exhibit::StaffPage::Buttons) {
            return {};
        }
        if (button == 1) {
            return "next page";
        }
        const bool is_first = button == 0;
        if (view_.page == exhibit::StaffPage::Light && button <= 2) {
            return is_first ? "white, black and greys in turn" : "the one before";
        }
        if (view_.page == exhibit::StaffPage::Sound && button <= 2) {
            return is_first ? "louder, with a tone; after the loudest comes the quietest"
                            : "quieter, with a tone";
        }
        return {};
    }

    void add_buttons() {
        double space = 1.0;
        const auto add_button = [&](std::string text) {
            add(std::move(text), 1.0, false, std::exchange(space, 0.3));
        };
        for (std::size_t button = 0; button < facts_.buttons; ++button) {
            if (const std::string action = action_of(button); !action.empty()) {
                add_button(fmt::format("{} {}", circled(button, view_), action));
            }
        }
        const bool measures = view_.page == exhibit::StaffPage::Place && facts_.calibrates;
        if (measures) {
            add_button(fmt::format("{} held for two seconds: measures the table", circled(0, view_)));
        }
        const bool resets = view_.page == exhibit::StaffPage::Status && view_.resets;
        if (resets) {
            add_button(
                fmt::format("{} held for two seconds: back to the state of delivery; settings, calibration, "
                            "visits and packs are removed",
                            circled(0, view_)));
        }
        const bool copies = view_.page == exhibit::StaffPage::Copy && view_.copies;
        if (copies) {
            add_button(fmt::format("{} held for two seconds: settings, calibration, visits and packs are "
                                   "copied to the stick",
                                   circled(0, view_)));
        }
        if (!view_.kept && !view_.stays && view_.page != exhibit::StaffPage::Buttons) {
            add_button(fmt::format("{} held for two seconds: this picture is kept for half an hour",
                                   measures || resets || copies ? circled(1, view_) : "any button"));
        }
        add_button(fmt::format("{} and {} held together for three seconds: back to the exhibit",
                               circled(0, view_), circled(facts_.buttons - 1, view_)));
    }

    void add_end() {
        add(view_.stays  ? "There is no calibration yet, so this picture stays until then."
            : view_.kept ? "It goes by itself half an hour after it came."
                         : "It goes by itself a minute after the last press.");
    }

    const exhibit::StaffView& view_;
    const StaffFacts& facts_;
    std::vector<Line> lines_;
};

void put(typography::Canvas& canvas, const image::Image<std::uint8_t>& words, const glm::ivec2& corner) {
    constexpr int margin_px = 8;
    const glm::dvec2 low(corner - margin_px);
    canvas.fill(low, low + glm::dvec2(words.width + 2 * margin_px, words.height + 2 * margin_px),
                typography::Colour(0));
    canvas.coverage(words, corner, white);
}

/// Puts the QR code at the upper right; returns its left edge. Below three pixels a module, which no telephone reads,
/// it is left out.
double put_code(typography::Canvas& canvas, const std::string& card, double margin_px) {
    const image::Image<std::uint8_t> code = qr_code(card);
    const image::Image8& picture = canvas.image();
    if (code.width == 0) {
        return picture.width;
    }
    const int module_px =
        static_cast<int>(std::min(0.42 * picture.width, picture.height - 2.0 * margin_px)) / code.width;
    if (module_px < 3) {
        return picture.width;
    }
    const glm::dvec2 corner(picture.width - std::round(margin_px) - module_px * code.width,
                            std::round(margin_px));
    for (int y = 0; y < code.height; ++y) {
        for (int x = 0; x < code.width; ++x) {
            const glm::dvec2 low = corner + static_cast<double>(module_px) * glm::dvec2(x, y);
            canvas.fill(low, low + static_cast<double>(module_px), typography::Colour(code.at(x, y)));
        }
    }
    return corner.x;
}

/// Puts each button with its number, its press count, and whether it is pressed.
void put_buttons(typography::Canvas& canvas, const exhibit::StaffView& view, std::size_t count, double unit,
                 const typography::Typesetter& typesetter) {
    const double width = canvas.image().width, height = canvas.image().height;
    const double radius = 60.0 * unit;
    for (std::size_t button = 0; button < count; ++button) {
        const glm::dvec2 centre(width * (static_cast<double>(button) + 0.5) / static_cast<double>(count),
                                0.68 * height);
        const bool is_lit = view.pressed == button;
        const bool counts = view.presses.at(button) > 0;
        if (is_lit) {
            canvas.circle(centre, radius / 2.0, radius, lit_colour);
        }
        canvas.circle(centre, radius, 4.0 * unit, counts ? lit_colour : ring_colour);
        canvas.text(typesetter, fmt::format("{}", button + 1), centre, 44.0 * unit,
                    is_lit ? typography::Colour(0) : white, {0.5, 0.5}, true);
        const std::string said = is_lit && view.held ? "held"
                                 : counts            ? fmt::format("{}\u00d7", view.presses.at(button))
                                                     : "not yet";
        canvas.text(typesetter, said, centre + glm::dvec2(0.0, radius + 12.0 * unit), 22.0 * unit, white,
                    {0.5, 0.0});
    }
}

} // namespace

image::Image8 staff_background(const exhibit::StaffView& view, const typography::PatternScene& scene,
                               const typography::Typesetter& typesetter) {
    const int width = scene.projector.width, height = scene.projector.height;
    const bool is_white = view.page == exhibit::StaffPage::Light && view.light == exhibit::StaffLight::White;
    if (view.page == exhibit::StaffPage::Place) {
        return typography::table_pattern(scene, typesetter);
    }
    if (view.page == exhibit::StaffPage::Focus) {
        return typography::focus_picture(width, height);
    }
    if (view.page == exhibit::StaffPage::Light && view.light == exhibit::StaffLight::Greys) {
        return typography::grey_picture(width, height, typesetter);
    }
    return {width, height, glm::u8vec4(glm::u8vec3(is_white ? 255 : 0), 255)};
}

image::Image8 staff_picture(const exhibit::StaffView& view, const StaffFacts& facts,
                            const typography::PatternScene& scene, const image::Image8& background,
                            const typography::Typesetter& typesetter) {
    const double unit = unit_px(scene);
    const double width = scene.projector.width, height = scene.projector.height;
    const double margin = 34.0 * unit;
    typography::Canvas canvas(background);
    const PageWords words(view, facts);
    const auto put_words = [&](const glm::dvec2& corner, const glm::dvec2& space, double em) {
        put(canvas, words.set(typesetter, space, em * unit), glm::ivec2(glm::round(corner)));
    };
    const double wide = width - 2.0 * margin;
    switch (view.page) {
    case exhibit::StaffPage::Status: {
        const double right = put_code(canvas, facts.card, margin);
        put_words({margin, margin}, {right - 2.0 * margin, height - 2.0 * margin}, 16.0);
        break;
    }
    case exhibit::StaffPage::Place: // below the pattern's own text
        put_words({30.0, 84.0}, {0.5 * wide, 0.5 * height}, 16.0);
        break;
    case exhibit::StaffPage::Focus: // between the stars
        put_words({0.08 * width, 0.235 * height}, {0.5 * wide, 0.18 * height}, 16.0);
        break;
    case exhibit::StaffPage::Light:
        if (view.light == exhibit::StaffLight::Greys) {
            put_words({margin, 0.73 * height}, {wide, 0.25 * height}, 18.0);
        } else if (view.has_words) {
            put_words({margin, 0.6 * height}, {wide, 0.36 * height}, 18.0);
        }
        break;
    case exhibit::StaffPage::Sound:
    case exhibit::StaffPage::Tracker:
    case exhibit::StaffPage::Copy:
        put_words({margin, margin}, {wide, height - 2.0 * margin}, 22.0);
        break;
    case exhibit::StaffPage::Buttons:
        put_words({margin, margin}, {wide, 0.5 * height}, 22.0);
        put_buttons(canvas, view, facts.buttons, unit, typesetter);
        break;
    }
    return canvas.take();
}

} // namespace frustumscreen::show
