// The staff's pages: another program (zbarimg, of the ZBar project) reads their QR code, and no word overlaps
// anything.

#include "app/settings/command.h"
#include "app/show/exhibit_place.h"
#include "app/show/qr_code.h"
#include "app/show/staff_picture.h"
#include "app/status/status_card.h"
#include "firmware_host/base/version.h"
#include "tests/base/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::show {
namespace {

constexpr const char* example_card = "FrustumScreen 0.1.0, 2026-05-01 12:00\n"
                                     "The exhibit runs and is well\n"
                                     "projector: the projector at HDMI-A-1 is lit, 1920 x 1200 at 60 Hz\n"
                                     "tracker: no tracker is connected; check its USB cable and its power\n"
                                     "packs: set 3: amphora nautilus-cup\n";

image::Image8 grown(const image::Image<std::uint8_t>& code, int module_px) {
    image::Image8 picture(code.width * module_px, code.height * module_px);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            picture.at(x, y) = glm::u8vec4(glm::u8vec3(code.at(x / module_px, y / module_px)), 255);
        }
    }
    return picture;
}

/// The picture as taken by a telephone held above the table: turned, darker, with noise.
image::Image8 photographed(const image::Image8& picture, double turn_deg) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 6.0);
    const int size = std::max(picture.width, picture.height) * 5 / 4;
    image::Image8 photo(size, size, {30, 30, 30, 255});
    const double c = std::cos(glm::radians(turn_deg)), s = std::sin(glm::radians(turn_deg));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 from_middle = glm::dvec2(x, y) - 0.5 * size;
            const glm::dvec2 turned(c * from_middle.x + s * from_middle.y,
                                    c * from_middle.y - s * from_middle.x);
            const glm::ivec2 at(glm::floor(turned + 0.5 * glm::dvec2(picture.width, picture.height)));
            const bool inside = at.x >= 0 && at.y >= 0 && at.x < picture.width && at.y < picture.height;
            const double code = inside ? 30.0 + 0.6 * picture.at(at.x, at.y).g : 30.0;
            photo.at(x, y) = glm::u8vec4(
                glm::u8vec3(static_cast<std::uint8_t>(std::clamp(code + noise(random), 0.0, 255.0))), 255);
        }
    }
    return photo;
}

class StaffPicture : public WithTemporaryFolder {
protected:
    void SetUp() override {
        typesetter.emplace(*typography::Typesetter::open());
        facts.lines = {"The exhibit runs and is well", "tracker: the tracker is running"};
        facts.card = example_card;
        facts.calibration = "calibration in use: calibration-0008.toml, made 2026-04-12 10:12 UTC, 19 days "
                            "ago, with 9 places (touch)";
        facts.tracker = "tracker: the tracker is running";
        facts.camera = "camera: the camera is running; 640 \u00d7 480 pixels, 30 frames a second";
        facts.panel = "buttons: its buttons are there";
        facts.sound = "sound: its sound goes to plughw:CARD=PCH,DEV=0";
        facts.prop = {240.0, 1.0, 0.04, 0.01};
        facts.speaks = facts.calibrates = facts.copies = true;
        facts.copy.said = "frustumscreen-1a2b3c-2026-05-01-120000";
    }
    /// The text read by zbarimg; empty for several codes or none.
    [[nodiscard]] std::string read(const image::Image8& picture) const {
        const std::filesystem::path file = folder / "picture.png";
        EXPECT_TRUE(write_file(file, image::encode_png(picture)));
        std::FILE* const said = popen(
            ("zbarimg --quiet --raw --oneshot -Sbinary " + file.string() + " 2>/dev/null").c_str(), "r");
        std::string text;
        std::array<char, 4096> part{};
        for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), said)) > 0;) {
            text.append(part.data(), count);
        }
        pclose(said);
        return text;
    }
    [[nodiscard]] image::Image8 page(const exhibit::StaffView& view) const {
        return staff_picture(view, facts, scene, staff_background(view, scene, *typesetter), *typesetter);
    }
    void set_size(int width, int height) {
        scene.projector = {width, height, 1.5 * width, 1.5 * width, 0.5 * width, 0.5 * height};
        scene.table_from_projector = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 1.5}};
        scene.table_size_m = {0.8, 0.5};
        scene.prop = geometry::make_frustum({});
    }

    StaffFacts facts;
    typography::PatternScene scene;
    std::optional<typography::Typesetter> typesetter;
};

TEST_F(StaffPicture, AnotherDecoderReadsTheQrCode) {
    for (const std::string& text : {std::string("a"), std::string(example_card), std::string("\u00e9 \u4e2d"),
                                    std::string(status::max_card_bytes, 'x')}) {
        EXPECT_EQ(read(grown(qr_code(text), 4)), text);
    }
    EXPECT_EQ(qr_code("").width, 0);
    EXPECT_EQ(qr_code(std::string(max_qr_bytes + 1, 'x')).width, 0);
    EXPECT_GT(qr_code(std::string(max_qr_bytes, 'x')).width, 0);
}

/// A cable covers a part, and the telephone is turned.
TEST_F(StaffPicture, QrCodeIsReadablePartlyHiddenAndTurned) {
    image::Image8 code = grown(qr_code(example_card), 5);
    const int below_finders = code.height / 2;
    for (int y = below_finders; y < below_finders + code.height / 16; ++y) {
        for (int x = code.width / 3; x < code.width; ++x) {
            code.at(x, y) = {120, 120, 120, 255};
        }
    }
    EXPECT_EQ(read(code), example_card);
    for (const double turn_deg : {-170.0, -35.0, 0.0, 20.0, 90.0}) {
        EXPECT_EQ(read(photographed(code, turn_deg)), example_card) << turn_deg;
    }
}

TEST_F(StaffPicture, StatusPagesQrCodeIsReadableWithAnyAmountOfText) {
    for (const auto& [width, height] :
         {std::pair(1280, 800), std::pair(1920, 1200), std::pair(1920, 1080), std::pair(1024, 768)}) {
        set_size(width, height);
        EXPECT_EQ(read(page({})), example_card) << width;
    }
    facts.card = std::string(status::max_card_bytes, 'W');
    facts.lines.assign(40, std::string(250, 'w') + " and what is to be done about that");
    for (const auto& [width, height] : {std::pair(1280, 800), std::pair(1920, 1200)}) {
        set_size(width, height);
        EXPECT_EQ(read(page({})), facts.card) << width;
    }
}

/// The picture's border stays free of words: there a word would be cut off, or lie beside the table.
TEST_F(StaffPicture, WordsStayWithinThePicture) {
    facts.lines.assign(25, "packs: set 3, 2 packs: Amphora, Nautilus cup; the newest is set 3, good; and "
                           "what else there is to say of them");
    for (const auto& [width, height] : {std::pair(1280, 800), std::pair(1920, 1200)}) {
        set_size(width, height);
        for (std::size_t buttons = 2; buttons <= settings::button_commands.size(); ++buttons) {
            facts.buttons = buttons;
            facts.stereo = buttons % 2 == 0; // has sentences of its own
            facts.measures_pixels = !facts.stereo;
            for (std::size_t k = 0; k < exhibit::staff_page_names.size() + 2; ++k) {
                exhibit::StaffView view;
                view.page =
                    static_cast<exhibit::StaffPage>(std::min(k, exhibit::staff_page_names.size() - 1));
                view.light = static_cast<exhibit::StaffLight>(k % 3);
                view.pressed = static_cast<std::uint8_t>(k % buttons);
                view.presses.fill(123);
                view.kept = k % 2 == 0;
                view.stays = k % 3 == 0;
                view.resets = view.copies = k % 2 == 0;
                facts.copy.stage = static_cast<exhibit::CopyStage>((k + buttons) % 7);
                const image::Image8 below = staff_background(view, scene, *typesetter);
                const image::Image8 shown = page(view);
                const int edge = height / 50;
                int changed = 0, changed_at_edge = 0, changed_at_letters = 0;
                for (int y = 0; y < height; ++y) {
                    for (int x = 0; x < width; ++x) {
                        const bool is_changed = shown.at(x, y) != below.at(x, y);
                        changed += is_changed ? 1 : 0;
                        changed_at_letters += is_changed && x > 0.58 * width ? 1 : 0;
                        changed_at_edge +=
                            is_changed && (x < edge || y < edge || x >= width - edge || y >= height - edge)
                                ? 1
                                : 0;
                    }
                }
                EXPECT_GT(changed, 1000) << k;
                if (view.page == exhibit::StaffPage::Place) {
                    EXPECT_EQ(changed_at_letters, 0) << "the letters of the eyes are there";
                }
                EXPECT_EQ(changed_at_edge, 0)
                    << exhibit::staff_page_names.at(static_cast<std::size_t>(view.page)) << " " << buttons;
            }
        }
    }
}

TEST_F(StaffPicture, CopyPageShowsEachStageAndTheProgress) {
    set_size(1280, 800);
    exhibit::StaffView view;
    view.page = exhibit::StaffPage::Copy;
    std::vector<std::vector<glm::u8vec4>> seen;
    const auto is_new = [&] {
        seen.push_back(page(view).texels);
        return std::count(seen.begin(), seen.end(), seen.back()) == 1;
    };
    for (int stage = 0; stage <= static_cast<int>(exhibit::CopyStage::Failed); ++stage) {
        facts.copy.stage = static_cast<exhibit::CopyStage>(stage);
        EXPECT_TRUE(is_new()) << stage;
    }
    facts.copy.said = "the stick is full; make room, or take another stick";
    EXPECT_TRUE(is_new()) << "why it failed";
    facts.copy = {.stage = exhibit::CopyStage::Writing, .percent = 40};
    EXPECT_TRUE(is_new());
    facts.copy = {.stage = exhibit::CopyStage::Offered};
    view.copies = true;
    EXPECT_TRUE(is_new()) << "which button";
    facts.copies = false;
    view.copies = false;
    EXPECT_TRUE(is_new()) << "a kiosk that writes to no stick";
}

TEST_F(StaffPicture, GreysHaveTheirNominalCodes) {
    set_size(1920, 1200);
    exhibit::StaffView view;
    view.page = exhibit::StaffPage::Light;
    view.light = exhibit::StaffLight::Greys;
    const image::Image8 greys = staff_background(view, scene, *typesetter);
    for (int k = 0; k < 16; ++k) {
        EXPECT_EQ(greys.at(60 + 120 * k, 100).r, 17 * k);
    }
    EXPECT_EQ(greys.at(60, 600).r, 0);
    EXPECT_EQ(greys.at(1860, 600).r, 255);
    EXPECT_EQ(greys.at(180, 600).r, 2);
}

library::InstalledPack pack_of(const char* id, const char* sha256) {
    library::InstalledPack pack;
    pack.id = id;
    pack.title = "\u0391";
    pack.sha256 = sha256;
    return pack;
}

TEST(StatusCard, IsPlainTextAndTruncatedToItsLimit) {
    status::StatusReport status;
    status.uptime_s = 36000.0;
    auto set = std::make_shared<status::SetStatus>();
    set->shown = 3;
    set->packs = {pack_of("amphora", ""), pack_of("", "0123456789abcdef")};
    status.set = set;
    std::vector<status::StatusLine> lines{{"tracker", "is \u201chere\u201d"},
                                          {"projector", "lit"},
                                          {"frame times", "many"},
                                          {"calibration in use", "none"}};
    EXPECT_EQ(status::status_card("well", status, lines, -1),
              fmt::format("FrustumScreen {}, 1970-01-01 00:00\nwell\nprojector: lit\ntracker: is "
                          "???here???\ncalibration in use: none\n"
                          "packs: set 3: amphora 01234567\nit runs for 10 h 0 min\n",
                          project_version()));
    for (status::StatusLine& line : lines) {
        line.text = std::string(1000, 'x');
    }
    set->packs.assign(200, pack_of("amphora", ""));
    lines.insert(lines.end(), {{"camera", std::string(500, 'y')},
                               {"buttons", std::string(500, 'y')},
                               {"sound", std::string(500, 'y')},
                               {"watchdog", std::string(500, 'y')},
                               {"machine", std::string(500, 'y')},
                               {"errors", std::string(500, 'y')}});
    const std::string card = status::status_card("well", status, lines, 0);
    EXPECT_LE(card.size(), status::max_card_bytes);
    EXPECT_GT(card.size(), status::max_card_bytes - status::max_card_line_bytes - 10);
    EXPECT_TRUE(card.ends_with("\n...\n"));
}

TEST(CalibrationLine, NamesFileAgeAndErrors) {
    settings::CalibrationSettings settings;
    EXPECT_EQ(calibration_line(settings, 0), "none; projector and tracker stand as the settings say");
    settings.used.emplace();
    settings.used_name = "calibration-0008.toml";
    settings.used->made = "2026-04-12 10:12 UTC";
    settings.used->places = 9;
    settings.used->mean_mm = 0.52;
    settings.used->worst_mm = 0.84;
    constexpr std::time_t first_of_may = 1777593600;
    EXPECT_EQ(calibration_line(settings, first_of_may),
              "calibration-0008.toml, made 2026-04-12 10:12 UTC, 19 days ago, with 9 places (touch); 0.5 mm "
              "on average, 0.8 mm at the worst of them");
    EXPECT_EQ(calibration_line(settings, 0).find("ago"), std::string::npos) << "a clock that was not set";
    settings.used->made = "2026-02-31";
    EXPECT_EQ(calibration_line(settings, first_of_may).find("ago"), std::string::npos);
}

/// The buttons can measure the table, and it has not been measured.
TEST(StaffStays, OnlyWhileAMeasurableTableIsUnmeasured) {
    settings::Settings settings;
    settings.tracker.kind = settings::TrackerKind::Usb;
    EXPECT_TRUE(exhibit_place(settings).staff_stays);
    settings.calibration.by_buttons = false;
    EXPECT_FALSE(exhibit_place(settings).staff_stays);
    settings.calibration.by_buttons = true;
    settings.tracker.kind = settings::TrackerKind::None;
    EXPECT_FALSE(exhibit_place(settings).staff_stays);
    settings.tracker.kind = settings::TrackerKind::Usb;
    settings.calibration.used.emplace();
    EXPECT_FALSE(exhibit_place(settings).staff_stays);
}

} // namespace
} // namespace frustumscreen::show
