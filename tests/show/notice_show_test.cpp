// The import of a stick, from the importer's report: in the table's pixels, in audio samples, in the journal and the
// status.
#include "app/pack/pack_file.h"
#include "app/render/read_back.h"
#include "app/scene/device_plan.h"
#include "app/show/artifact_show.h"
#include "app/show/import_journal.h"
#include "app/show/live_exhibit.h"
#include "firmware_host/base/json.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/sound/mixer.h"
#include "firmware_host/sound/opus_reader.h"
#include "tests/base/comes_true.h"
#include "tests/base/temporary_folder.h"
#include "tests/exhibit/block_words.h"
#include "tests/folders.h"
#include "tests/render/counted_new.h"
#include "tests/show/shown_packs.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <set>

namespace frustumscreen::synthetic {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int width = 960;
constexpr int height = 600;

library::ImportReport report_of(library::ImportStage stage, std::uint64_t done = 0) {
    library::ImportReport report;
    report.import_id = "first";
    report.stick = "MUSEUM";
    report.stage = stage;
    report.done_bytes = done;
    report.total_bytes = 1000;
    return report;
}
library::ImportReport done_with(std::size_t packs) {
    library::ImportReport report = report_of(library::ImportStage::Done, 1000);
    for (std::size_t k = 0; k < packs; ++k) {
        report.packs.push_back({fmt::format("{}.fspack", k), fmt::format("Title {}", k),
                                library::ImportOutcome::Taken, library::ImportRefusal::None, ""});
    }
    return report;
}
void put_report(const fs::path& file, const library::ImportReport& report) {
    ASSERT_TRUE(write_file(file, as_bytes(library::write_import_report(report))));
}

class Notice : public WithTemporaryFolder {
protected:
    void SetUp() override {
        report = folder / "report.json";
        pack::LanguageWords words = block_words("en", pack::TextDirection::LeftToRight);
        words.sounds["stick.take_out"] = tone();
        ASSERT_TRUE(write_file(folder / "own.fswords", *pack::write_words(std::array{words})));
        start(true);
    }
    static Bytes tone() { return *read_file(source_dir() + "/tests/sound/fixtures/tone.opus"); }

    void start(bool with_words) {
        settings = **settings::parse_settings(
            fmt::format(
                "[projector]\nwidth = {}\nheight = {}\n[exhibit]\nguidance = false\ntable_pictures = false\n"
                "import_report = \"{}\"\n{}",
                width, height, report.string(),
                with_words ? fmt::format("words = \"{}\"\n", (folder / "own.fswords").string()) : ""),
            "kiosk.toml");
        settings.panel.script = {{1.0, 0}, {2.0, 1}};
        show::ArtifactShowOptions options{packs.files(), "level0", 1, scene::AllCullKinds}; // no governor
        options.waits = true;
        now = MonotonicTime(seconds(100));
        auto artifacts = show::ArtifactShow::create(settings, scene::plan_devices(settings, false, false),
                                                    options, {display->framebuffer(), 0})
                             .value();
        exhibit::Exhibit exhibit = show::make_exhibit(settings, *artifacts, now);
        show = std::make_unique<show::LiveExhibit>(settings, std::move(artifacts), std::move(exhibit),
                                                   "a driver", residency::PromptReader::Answer::Always);
        tracked_state.prop_known = true;
        tracked_state.eye_m = settings.eye.default_m;
        wait(milliseconds(1500));
    }
    void wait(Nanoseconds time, std::span<const settings::Command> commands = {}) {
        const MonotonicTime end = now + time;
        while (now < end) {
            now += milliseconds(20);
            tracked_state.table_from_prop.translation.x =
                now.time_since_epoch() % seconds(1) < milliseconds(500) ? 0.0 : 0.004; // a visitor is present
            show->step(now, std::exchange(commands, {}), tracked_state);
            std::vector<std::int16_t> block(sound::sample_rate_hz / 50);
            mixer.mix(block);
            mixer.follow(show->sound_request());
            heard.insert(heard.end(), block.begin(), block.end());
            show->hear(mixer.report(Nanoseconds(0)));
        }
        tracked_state.table_from_prop.translation.x = 0.0;
        show->step(now, {}, tracked_state);
    }
    image::Image8 picture() {
        static_cast<void>(
            show->draw(now, tracked_state, {display->framebuffer(), 0}, render::Redraw::Everything));
        return render::read_colour(display->framebuffer(), width, height);
    }
    /// Codes of the pixels in which two pictures differ, by place: 0 where they are equal.
    static image::Image<std::uint8_t> difference(const image::Image8& without, const image::Image8& with) {
        image::Image<std::uint8_t> light(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                light.at(x, y) = without.at(x, y) == with.at(x, y) ? 0 : with.at(x, y).g;
            }
        }
        return light;
    }
    static int left_of(const image::Image<std::uint8_t>& light) {
        int left = width;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                left = light.at(x, y) > 0 ? std::min(left, x) : left;
            }
        }
        return left;
    }
    static long lit(const image::Image<std::uint8_t>& light) {
        return std::count_if(light.texels.begin(), light.texels.end(),
                             [](std::uint8_t c) { return c > 100; });
    }

    ShownPacks packs{3};
    fs::path report;
    settings::Settings settings;
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(width, height).value();
    std::unique_ptr<show::LiveExhibit> show;
    tracking::TrackedState tracked_state;
    sound::Mixer mixer;
    std::vector<std::int16_t> heard;
    MonotonicTime now;
};

TEST_F(Notice, DrawsAndAllocatesNothingWithoutAReport) {
    const image::Image8 with_words = picture();
    const long before = allocations_so_far();
    for (int k = 0; k < 100; ++k) {
        now += milliseconds(20);
        show->step(now, {}, tracked_state);
        static_cast<void>(
            show->draw(now, tracked_state, {display->framebuffer(), 1}, render::Redraw::Changes));
    }
    if (allocations_are_counted) {
        EXPECT_EQ(allocations_so_far(), before);
    }
    start(false);
    EXPECT_EQ(picture().texels, with_words.texels);
}

TEST_F(Notice, RingShowsTheShareThatIsCopied) {
    const image::Image8 without = picture();
    for (const std::uint64_t done : {150U, 400U, 800U}) {
        put_report(report, report_of(library::ImportStage::Copying, done));
        wait(seconds(2));
        const image::Image<std::uint8_t> light = difference(without, picture());
        const double px_per_m =
            settings.projector.pinhole.fx / settings.projector.table_from_projector.translation.z;
        const int left = left_of(light);
        const int ring_px = static_cast<int>(0.034 * px_per_m); // 16 mm on each side, then letters
        int full = 0;
        int empty = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = left; x < left + ring_px; ++x) {
                full += light.at(x, y) > 150 ? 1 : 0;
                empty += light.at(x, y) > 40 && light.at(x, y) <= 150 ? 1 : 0;
            }
        }
        EXPECT_GT(full + empty, 300);
        EXPECT_NEAR(1.0 * full / (full + empty), static_cast<double>(done) / 1000.0, 0.07) << done;
        EXPECT_GT(lit(light), full + 100) << "and letters beside it";
    }
}

TEST_F(Notice, LinesEndAfterTwoMinutesOrAtAPressThatDoesNothingElse) {
    const image::Image8 without = picture();
    const std::string_view shown = show->state().artifact;
    put_report(report, done_with(1));
    wait(seconds(2));
    const long one = lit(difference(without, picture()));
    EXPECT_GT(one, 100);
    wait(seconds(115));
    EXPECT_GT(lit(difference(without, picture())), 100);
    wait(seconds(5));
    EXPECT_EQ(picture().texels, without.texels);

    library::ImportReport second = done_with(3);
    second.import_id = "second";
    put_report(report, second);
    wait(seconds(2));
    EXPECT_GT(lit(difference(without, picture())), one + 100);
    wait(seconds(2), std::array{settings::Command::NextArtifact});
    EXPECT_EQ(picture().texels, without.texels);
    EXPECT_EQ(show->state().artifact, shown);
    wait(seconds(2), std::array{settings::Command::NextArtifact});
    EXPECT_NE(show->state().artifact, shown) << "the next press is a visitor's again";
}

TEST_F(Notice, PressesChooseArtifactsWhileCopyingAndTheChordUndoesNone) {
    put_report(report, report_of(library::ImportStage::Copying, 100));
    wait(seconds(2));
    const std::string first(show->state().artifact);
    wait(seconds(2), std::array{settings::Command::PreviousArtifact});
    const std::string chosen(show->state().artifact);
    EXPECT_NE(chosen, first);
    put_report(report, done_with(1));
    wait(seconds(2));
    wait(seconds(1), std::array{settings::Command::PreviousArtifact}); // ends the lines
    wait(seconds(1), std::array{settings::Command::StaffMode});
    EXPECT_EQ(show->state().state, exhibit::State::Staff);
    wait(seconds(1), std::array{settings::Command::StaffMode});
    wait(seconds(2));
    EXPECT_EQ(show->state().artifact, chosen);
}

TEST_F(Notice, PressBetweenTwoNoticesEndsTheSecondAndDoesNothingElse) {
    const image::Image8 without = picture();
    const std::string shown(show->state().artifact);
    put_report(report, report_of(library::ImportStage::MayTakeOut, 1000));
    wait(seconds(2));
    EXPECT_NE(picture().texels, without.texels);
    put_report(report, done_with(1));
    for (int k = 0; k < 100 && picture().texels != without.texels; ++k) {
        wait(milliseconds(20));
    }
    ASSERT_EQ(lit(difference(without, picture())), 0)
        << "the first has gone, and the second is not there yet";
    wait(milliseconds(20), std::array{settings::Command::NextArtifact});
    wait(seconds(2)); // the earlier notice has begun to fade
    EXPECT_EQ(lit(difference(without, picture())), 0);
    EXPECT_EQ(show->state().artifact, shown);
}

TEST_F(Notice, AnnouncesOnceThatTheStickMayBeTakenOut) {
    const std::vector<std::int16_t> truth = sound::read_opus(tone())->samples;
    const auto is_loud = [&] {
        return std::count_if(heard.begin(), heard.end(), [](std::int16_t s) { return std::abs(s) > 300; });
    };
    put_report(report, report_of(library::ImportStage::Copying, 500));
    wait(seconds(2));
    EXPECT_EQ(is_loud(), 0);
    put_report(report, report_of(library::ImportStage::MayTakeOut, 1000));
    wait(seconds(10));
    const auto spoken = std::search(heard.begin(), heard.end(), truth.begin() + 1000, truth.begin() + 3000);
    EXPECT_NE(spoken, heard.end()) << "the words are not there";
    const auto loud = is_loud();
    put_report(report, done_with(2));
    wait(seconds(20));
    EXPECT_EQ(is_loud(), loud) << "it is said once";
}

TEST_F(Notice, IgnoresAFileThatIsNoReport) {
    const image::Image8 without = picture();
    for (const std::string& bytes :
         {std::string("{"), std::string("[]"), std::string(20U << 20U, '['), std::string()}) {
        ASSERT_TRUE(write_file(report, as_bytes(bytes)));
        wait(seconds(1));
        EXPECT_EQ(picture().texels, without.texels);
    }
    fs::remove(report);
    ASSERT_EQ(::mkfifo(report.c_str(), 0600), 0);
    wait(seconds(1));
    EXPECT_EQ(picture().texels, without.texels);
    fs::remove(report);
    put_report(report, done_with(1));
    wait(seconds(1));
    EXPECT_NE(picture().texels, without.texels);
}

TEST_F(Notice, DoesNotShowAnImportThatEndedLongBeforeTheStart) {
    const image::Image8 without = picture();
    put_report(report, done_with(3));
    fs::last_write_time(report, fs::file_time_type::clock::now() - seconds(125));
    start(true);
    EXPECT_EQ(picture().texels, without.texels);
    ASSERT_NE(show->state().import, nullptr) << "the status has it all the same";
    show::RunStatus status;
    status.import = show::report_of(show->state().import);
    EXPECT_EQ(nlohmann::json::parse(status::status_json(status)).at("import").at("packs")[2].at("title"),
              "Title 2");
    EXPECT_TRUE(nlohmann::json::parse(status::status_json(show::RunStatus())).at("import").is_null());
}

TEST_F(Notice, ShowsAJustFinishedImportAfterARestart) {
    const image::Image8 without = picture();
    for (const seconds age : {seconds(100), seconds(-100'000)}) { // the wall clock may have been set
        put_report(report, done_with(3));
        fs::last_write_time(report, fs::file_time_type::clock::now() - age);
        start(true);
        EXPECT_NE(picture().texels, without.texels) << age.count();
    }
}

TEST_F(Notice, RereadsAReportThatWasUnreadable) {
    const image::Image8 without = picture();
    const std::string json = library::write_import_report(done_with(1));
    ASSERT_TRUE(write_file(report, as_bytes(std::string(json.size(), ' '))));
    struct stat before {};
    ASSERT_EQ(::stat(report.c_str(), &before), 0);
    wait(seconds(1));
    EXPECT_EQ(picture().texels, without.texels);
    std::ofstream(report, std::ios::in | std::ios::binary) << json; // a file of the same size
    const std::array<timespec, 2> times{before.st_atim, before.st_mtim};
    ASSERT_EQ(::utimensat(AT_FDCWD, report.c_str(), times.data(), 0), 0);
    wait(seconds(6));
    EXPECT_NE(picture().texels, without.texels);
}

TEST(ImportWatch, ReadsReportsThatAreRenamedIntoPlace) {
    const fs::path file = fs::temp_directory_path() / fmt::format("frustumscreen_report_{}.json", ::getpid());
    fs::remove(file);
    std::atomic<int> drawn{0};
    show::ImportWatch watch(
        file,
        [&](const exhibit::NoticeText& text, const exhibit::NoticeText&) {
            ++drawn;
            return std::make_shared<const exhibit::NoticePicture>(exhibit::NoticePicture{text, {}, {}});
        },
        show::ImportWatch::Answer::WhenReady);
    EXPECT_EQ(watch.latest({}), nullptr);
    const auto wait_for = [&](const library::ImportReport& report) {
        put_report(file, report);
        return comes_true([&] { return watch.latest({}) && watch.latest({})->report == report; });
    };
    for (std::uint64_t done = 0; done < 4; ++done) {
        ASSERT_TRUE(wait_for(report_of(library::ImportStage::Copying, done)));
    }
    EXPECT_EQ(drawn, 2) << "the words of a copy are drawn once, and that it stopped";
    EXPECT_FALSE(watch.latest({})->is_old);
    ASSERT_TRUE(wait_for(done_with(500)));
    EXPECT_EQ(watch.latest({})->notice->text.lines.size(), exhibit::max_notice_lines);
    fs::remove(file);
}

TEST(ImportJournal, LogsALineForEachStageAndEachPack) {
    show::ImportJournal journal;
    std::vector<std::string> lines;
    const auto note = [&](const library::ImportReport& report, bool is_old = false) {
        const std::size_t before = lines.size();
        journal.note(
            std::make_shared<const show::SeenImport>(show::SeenImport{report, is_old, nullptr, nullptr}),
            [&](service::LogPriority, const Sentence& line) { lines.emplace_back(line.view()); });
        return lines.size() - before;
    };
    EXPECT_EQ(note(done_with(500), true), 0U);
    library::ImportReport copying = report_of(library::ImportStage::Copying, 1);
    copying.import_id = "second";
    EXPECT_EQ(note(copying), 1U);
    EXPECT_EQ(lines.back(), "stick: 1000 bytes are copied");
    copying.done_bytes = 2;
    EXPECT_EQ(note(copying), 0U);
    library::ImportReport done = done_with(500);
    done.import_id = "second";
    done.packs[3] = {"coin.fspack", "", library::ImportOutcome::Refused, library::ImportRefusal::Altered,
                     "its hash is another"};
    const std::size_t before = lines.size();
    for (std::size_t written = 1; written > 0;) {
        written = note(done);
        EXPECT_LE(written, show::ImportJournal::max_lines + 1);
    }
    EXPECT_EQ(lines.size() - before, 501U);
    EXPECT_EQ(std::set<std::string>(lines.begin(), lines.end()).size(), lines.size());
    EXPECT_EQ(lines[before + 4], "stick: coin.fspack: refused: its hash is another");
    EXPECT_EQ(lines[before + 1], "stick: 0.fspack: taken: Title 0");
}

TEST(ImportJournal, LogsAFinishedImportCompletelyBeforeTheNext) {
    show::ImportJournal journal;
    std::vector<std::string> lines;
    const auto note = [&](const library::ImportReport& report) {
        journal.note(
            std::make_shared<const show::SeenImport>(show::SeenImport{report, false, nullptr, nullptr}),
            [&](service::LogPriority, const Sentence& line) { lines.emplace_back(line.view()); });
    };
    note(done_with(40));
    library::ImportReport second = report_of(library::ImportStage::Copying, 1);
    second.import_id = "second";
    for (int k = 0; k < 5; ++k) {
        note(second);
    }
    ASSERT_EQ(lines.size(), 42U);
    EXPECT_EQ(lines[40], "stick: 39.fspack: taken: Title 39");
    EXPECT_EQ(lines[41], "stick: 1000 bytes are copied");
}

} // namespace
} // namespace frustumscreen::synthetic
