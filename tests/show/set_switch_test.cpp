// Sets of packs installed while the exhibit runs: real packs, a real library's files, a display without a screen.

#include "app/library/set_file.h"
#include "app/pack/container/sha256.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/sign_pack.h"
#include "app/pack/signature/secret_key.h"
#include "app/render/read_back.h"
#include "app/scene/device_plan.h"
#include "app/show/installed_show.h"
#include "app/show/set_switch.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/comes_true.h"
#include "tests/base/temporary_folder.h"
#include "tests/show/shown_packs.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <thread>

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace fs = std::filesystem;

/// A pack with an id of its own, as curators' packs have.
Bytes pack_of(std::size_t number) {
    pack::Pack pack = numbered_pack(number);
    pack.id = fmt::format("rings-{}", number);
    return pack::write_pack(pack).value();
}

class SetSwitching : public WithTemporaryFolder {
protected:
    void SetUp() override {
        fs::create_directories(folder / "packs");
        settings.exhibit.library = folder;
        settings.exhibit.captions = false;
        settings.projector.pinhole = settings.projector.pinhole.scaled_to(320, 200);
        options.technique = "finest"; // no governor: pictures can be compared
        options.other_sets = true;
        options.waits = true; // for the texts of a compared picture
        devices.other_packs = true;
    }
    void TearDown() override {
        sets.reset(); // before the show, which it uses
        show.reset();
    }

    /// A set of packs, by their numbers; `spoiled` is an index of a pack whose levels are damaged, but not its
    /// manifest.
    library::InstalledSet put(std::uint64_t number, const std::vector<std::size_t>& packs,
                              std::optional<std::size_t> spoiled = {}) {
        library::InstalledSet set;
        set.number = number;
        for (std::size_t k = 0; k < packs.size(); ++k) {
            Bytes bytes = pack_of(packs[k]);
            if (spoiled == k) {
                bytes[bytes.size() / 2] ^= std::byte{0x40};
            }
            library::InstalledPack pack;
            pack.sha256 = pack::sha256_hex(bytes);
            pack.file = library::installed_file_name(pack.sha256);
            pack.id = fmt::format("rings-{}", packs[k]);
            pack.title = fmt::format("Rings {}", packs[k]);
            pack.bytes = bytes.size();
            EXPECT_TRUE(write_file(folder / pack.file, bytes));
            set.packs.push_back(pack);
        }
        return set;
    }
    void install(const library::InstalledSet& set,
                 const std::optional<library::InstalledSet>& last_good = {}) {
        library::SetFile file;
        file.choice = {set, last_good};
        ASSERT_TRUE(write_file(folder / library::set_file_name, as_bytes(library::write_set_file(file))));
    }
    [[nodiscard]] std::unique_ptr<show::ArtifactShow> create(const show::ArtifactShowOptions& each) {
        return show::ArtifactShow::create(settings, devices, each, {display->framebuffer(), 0}).value();
    }
    void start() {
        show::InstalledShow installed = show::show_installed_set(
            settings, options, show::Trust::Newest, [&](const show::ArtifactShowOptions& each) {
                return show::ArtifactShow::create(settings, devices, each, {display->framebuffer(), 0});
            });
        ASSERT_TRUE(installed.show);
        show = std::move(installed.show);
        exhibit.emplace(show::make_exhibit(settings, *show, now));
        switches = 0;
        sets.emplace(*show, std::make_unique<show::LibraryWatch>(
                                settings, show::LibraryWatch::SetUp{
                                              folder, show->set_options(), show->expected_frames(),
                                              std::move(installed.start), show->set().number, milliseconds(2),
                                              milliseconds(300)}));
    }
    void step(std::span<const settings::Command> commands = {}, Nanoseconds length = milliseconds(40)) {
        now += length;
        tracking::TrackedState tracked_state;
        tracked_state.prop_known = true;
        tracked_state.eye_m = settings.eye.default_m;
        switches += sets->step(now, shown.state, *exhibit) ? 1U : 0U;
        exhibit->note(show->artifacts());
        shown = exhibit->step(now, commands, tracked_state);
        sets->report(now, shown.state);
        static_cast<void>(show->draw(now, shown, std::span(&tracked_state.eye_m, 1),
                                     {display->framebuffer(), 0}, render::Redraw::Everything));
    }
    void visit() {
        step(next);
        step(previous);
        rest();
    }
    void rest() {
        for (int k = 0; k < 30; ++k) {
            step();
        }
    }
    /// The wall-clock limit of `await`, which steps until `is_so`.
    static constexpr Nanoseconds only_a_hang =
        seconds(300); ///< reached only in a hang, even on a busy machine under a sanitizer
    bool await(const std::function<bool()>& is_so) {
        return comes_true(
            [&] {
                if (!is_so()) {
                    step();
                }
                return is_so();
            },
            only_a_hang);
    }
    bool await_switches(std::uint64_t number) {
        return await([&] { return switches >= number; });
    }
    [[nodiscard]] image::Image8 picture() const {
        return render::read_colour(display->framebuffer(), 320, 200);
    }
    /// The picture of an exhibit that was started with these packs alone.
    image::Image8 picture_of(const std::vector<std::size_t>& packs) {
        show::ArtifactShowOptions own = options;
        own.other_sets = false;
        for (const library::InstalledPack& pack : put(1000, packs).packs) {
            own.packs.push_back(folder / pack.file);
        }
        const std::unique_ptr<show::ArtifactShow> alone = create(own);
        exhibit::Exhibit its = show::make_exhibit(settings, *alone, now);
        for (int k = 0; k < 30; ++k) {
            now += milliseconds(40);
            tracking::TrackedState tracked_state;
            tracked_state.prop_known = true;
            tracked_state.eye_m = settings.eye.default_m;
            const exhibit::Presentation presentation = its.step(now, {}, tracked_state);
            static_cast<void>(alone->draw(now, presentation, std::span(&tracked_state.eye_m, 1),
                                          {display->framebuffer(), 0}, render::Redraw::Everything));
        }
        return picture();
    }
    [[nodiscard]] library::SetVerdict verdict() const {
        return show::read_verdict(folder).value_or(library::SetVerdict{});
    }

    settings::Settings settings = settings::steep_table();
    show::ArtifactShowOptions options;
    scene::DevicePlan devices;
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(320, 200).value();
    std::unique_ptr<show::ArtifactShow> show;
    std::optional<exhibit::Exhibit> exhibit;
    std::optional<show::SetSwitch> sets;
    std::uint64_t switches = 0; ///< of sets, since the start
    exhibit::Presentation shown;
    MonotonicTime now{seconds(100)};
    const std::array<settings::Command, 1> next{settings::Command::NextArtifact};
    const std::array<settings::Command, 1> previous{settings::Command::PreviousArtifact};
};

TEST_F(SetSwitching, StatusListsPacksOfExpiredOrUnknownKeys) {
    const pack::SecretKey museum = pack::SecretKey::make();
    const pack::SecretKey other = pack::SecretKey::make();
    const auto signed_by = [](const pack::SecretKey& key, const Bytes& pack) {
        Result<pack::ZipReader> zip = pack::ZipReader::open(pack);
        const Bytes manifest = zip->read(zip->entries().front()).value();
        return pack::with_signature(pack, key.sign(manifest, "serial:1")).value();
    };
    library::InstalledSet set = put(1, {1, 2});
    for (std::size_t k = 0; k < 2; ++k) {
        const Bytes bytes = signed_by(k == 0 ? museum : other, pack_of(k + 1));
        set.packs[k].sha256 = pack::sha256_hex(bytes);
        set.packs[k].file = library::installed_file_name(set.packs[k].sha256);
        set.packs[k].bytes = bytes.size();
        ASSERT_TRUE(write_file(folder / set.packs[k].file, bytes));
    }
    install(set);
    const std::chrono::sys_days today = std::chrono::sys_days(std::chrono::year(2026) / 11 / 27);
    EXPECT_EQ(show::packs_of_ended_keys(folder, set, settings, today), "") << "no key is asked for";
    settings.exhibit.keys = {{"museum", museum.public_key(), std::nullopt}};
    EXPECT_EQ(show::packs_of_ended_keys(folder, set, settings, today), "rings-2");
    settings.exhibit.keys.push_back({"other", other.public_key(), today});
    EXPECT_EQ(show::packs_of_ended_keys(folder, set, settings, today), "") << "its last day";
    EXPECT_EQ(show::packs_of_ended_keys(folder, set, settings, today + std::chrono::days(1)), "rings-2");
    settings.exhibit.keys.pop_back();
    start();
    ASSERT_TRUE(await([&] { return sets->status() && sets->status()->of_ended_keys == "rings-2"; }));
}

TEST_F(SetSwitching, ANewSetReplacesTheOldOnePixelForPixel) {
    const image::Image8 expected = picture_of({4});
    const library::InstalledSet one = put(1, {0, 1});
    install(one);
    start();
    visit();
    const image::Image8 before = picture();
    EXPECT_NE(before.texels, expected.texels);
    const std::uint64_t gpu_bytes = show->use().gpu_bytes;

    install(put(2, {4}), one);
    ASSERT_TRUE(await_switches(1));
    rest();
    EXPECT_EQ(show->set().number, 2U);
    EXPECT_EQ(picture().texels, expected.texels);
    EXPECT_EQ(show->state(shown).artifact, "Rings 4");
    rest(); // the old set is released frame by frame
    EXPECT_EQ(show->use().gpu_bytes, show->use().planned_gpu_bytes);
    EXPECT_LT(show->use().gpu_bytes, gpu_bytes);
    EXPECT_EQ(verdict(), (library::SetVerdict{2, library::TrialState::Trying, 1, ""}));
    ASSERT_TRUE(await([&] { return sets->status() && sets->status()->shown == 2; }));
    EXPECT_TRUE(sets->status()->on_trial);
    ASSERT_EQ(sets->status()->packs.size(), 1U);
    EXPECT_EQ(sets->status()->packs[0].title, "Rings 4");
}

TEST_F(SetSwitching, ANewSetsTablePicturesAreDrawnAsAfterAStart) {
    settings.exhibit.table_pictures = true;
    const image::Image8 expected = picture_of({3, 4, 5});
    const library::InstalledSet one = put(1, {0});
    install(one);
    start();
    visit();
    install(put(2, {3, 4, 5}), one);
    ASSERT_TRUE(await_switches(1));
    ASSERT_NE(shown.table, nullptr);
    EXPECT_GE(shown.table->pictures().size(), 2U);
    EXPECT_TRUE(await([&] { return picture().texels == expected.texels; }));
}

TEST_F(SetSwitching, KeepsTheChosenArtifactIfTheNewSetContainsIt) {
    settings.exhibit.table_pictures = false; // otherwise names would differ
    install(put(1, {0, 1, 2}));
    start();
    visit();
    step(next);
    rest();
    ASSERT_EQ(exhibit->chosen(), 1U);
    const image::Image8 before = picture();
    install(put(2, {3, 4, 1}), put(1, {0, 1, 2}));
    ASSERT_TRUE(await_switches(1));
    rest();
    EXPECT_EQ(exhibit->chosen(), 2U);
    EXPECT_EQ(picture().texels, before.texels);
}

TEST_F(SetSwitching, ASetIsGoodAfterHalfAMinuteOfTheExhibitsTime) {
    const library::InstalledSet one = put(1, {0});
    install(put(2, {1}), one);
    start();
    visit();
    for (int k = 0; k < 27; ++k) {
        step({}, seconds(1));
        std::this_thread::sleep_for(milliseconds(10));
    }
    EXPECT_EQ(verdict().state, library::TrialState::Trying);
    ASSERT_TRUE(await([&] { return verdict().state == library::TrialState::Good; }));
    EXPECT_EQ(switches, 0U);
}

TEST_F(SetSwitching, NeverShowsASetWithATruncatedPack) {
    const library::InstalledSet one = put(1, {0});
    install(one);
    start();
    visit();
    const library::InstalledSet broken = put(2, {3, 4});
    fs::resize_file(folder / broken.packs[1].file, 100);
    install(broken, one);
    ASSERT_TRUE(await([&] { return verdict().number == 2 && verdict().state == library::TrialState::Bad; }));
    rest();
    EXPECT_NE(verdict().reason.find(broken.packs[1].file), std::string::npos) << verdict().reason;
    EXPECT_EQ(switches, 0U);
    EXPECT_EQ(show->set().number, 1U);
    const library::InstalledSet good = put(3, {4});
    install(good, one);
    EXPECT_TRUE(await_switches(1));
    EXPECT_EQ(show->set().number, 3U);
}

TEST_F(SetSwitching, RestoresTheLastGoodSetWhenAPackFailsLater) {
    const library::InstalledSet one = put(1, {0});
    install(one);
    start();
    visit();
    const image::Image8 before = picture();
    install(put(2, {3, 4}, 1), one); // the second pack's levels are read on request
    ASSERT_TRUE(await_switches(1));
    ASSERT_TRUE(await_switches(2));
    rest();
    EXPECT_EQ(show->set().number, 1U);
    EXPECT_EQ(picture().texels, before.texels);
    EXPECT_EQ(verdict().number, 2U);
    EXPECT_EQ(verdict().state, library::TrialState::Bad);
    EXPECT_NE(verdict().reason.find("damaged"), std::string::npos) << verdict().reason;
}

TEST_F(SetSwitching, TheFourthStartWithoutAVerdictShowsTheLastGoodSet) {
    install(put(2, {3}), put(1, {0}));
    const fs::path left = folder / "shown/verdict.json.part4194305"; // of a process that does not exist
    fs::create_directory(left.parent_path());
    ASSERT_TRUE(write_file(left, {}));
    for (int begun = 1; begun <= library::max_starts; ++begun) {
        start();
        step();
        EXPECT_EQ(show->set().number, 2U);
        EXPECT_EQ(verdict().starts, begun);
        sets.reset(); // no verdict results
        show.reset();
    }
    start();
    EXPECT_EQ(show->set().number, 1U);
    EXPECT_EQ(verdict().state, library::TrialState::Bad);
    EXPECT_FALSE(fs::exists(left));
    step();
    rest();
    EXPECT_EQ(switches, 0U);
}

TEST_F(SetSwitching, ABrokenFirstSetFallsBackToTheSettingsPacksElseItsOwn) {
    const library::InstalledSet broken = put(1, {3, 4});
    const fs::path own = folder / put(0, {0}).packs[0].file;
    fs::remove(folder / broken.packs[0].file);
    install(broken, library::InstalledSet());
    settings.exhibit.packs = {own};
    start();
    EXPECT_EQ(show->set().number, 0U);
    EXPECT_EQ(verdict().state, library::TrialState::Bad);
    sets.reset();
    show.reset();
    settings.exhibit.packs.clear();
    start();
    EXPECT_EQ(show->set().number, 1U);
    EXPECT_EQ(verdict().state, library::TrialState::Bad);
}

TEST_F(SetSwitching, AStartWithABrokenSetShowsTheLastGoodSet) {
    const library::InstalledSet broken = put(2, {3, 4});
    fs::remove(folder / broken.packs[0].file);
    install(broken, put(1, {0}));
    start();
    EXPECT_EQ(show->set().number, 1U);
    EXPECT_EQ(verdict().state, library::TrialState::Bad);
}

TEST_F(SetSwitching, RetriesAVerdictThatCouldNotBeWritten) {
    install(put(2, {3}), put(1, {0}));
    std::ofstream(folder / "shown") << "a file in the folder's place";
    start();
    EXPECT_EQ(show->set().number, 1U) << "its start cannot be counted";
    visit();
    ASSERT_TRUE(await([&] { return sets->status() && !sets->status()->trouble.empty(); }));
    EXPECT_EQ(switches, 0U);
    fs::remove(folder / "shown");
    ASSERT_TRUE(await_switches(1));
    EXPECT_EQ(show->set().number, 2U);
    EXPECT_EQ(verdict(), (library::SetVerdict{2, library::TrialState::Trying, 1, ""}));
    ASSERT_TRUE(await([&] { return sets->status()->trouble.empty(); }));
}

TEST_F(SetSwitching, AFailedStartOfTheShowCondemnsNoSet) {
    install(put(2, {3}), put(1, {0}));
    show::InstalledShow none = show::show_installed_set(
        settings, options, show::Trust::Newest,
        [](const show::ArtifactShowOptions&) -> Result<std::unique_ptr<show::ArtifactShow>> {
            return fail(ErrorKind::DeviceLost, "test.device", "the driver has no memory");
        });
    EXPECT_FALSE(none.show);
    EXPECT_EQ(verdict(), (library::SetVerdict{2, library::TrialState::Trying, 1, ""}));
    start();
    EXPECT_EQ(show->set().number, 2U);
}

TEST_F(SetSwitching, ASetRefusedByTheDriverIsBadAndNotOfferedAgain) {
    const library::InstalledSet one = put(1, {0});
    install(one);
    start();
    sets.reset();
    settings.exhibit.words = folder / "none.fswords"; // missing, which gives a note
    settings.exhibit.guidance = true;
    show::LibraryWatch library(settings, {folder, show->set_options(), show->expected_frames(),
                                          show::start_library(folder), 1, milliseconds(2)});
    ::testing::internal::CaptureStderr();
    install(put(2, {3}), one);
    std::unique_ptr<show::ShownSet> coming;
    ASSERT_TRUE(comes_true([&] { return (coming = library.take()) != nullptr; }, only_a_hang));
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("signs without words"), std::string::npos);
    coming->trouble = "the driver has no memory";
    ASSERT_TRUE(library.give_back(coming));
    ASSERT_TRUE(comes_true([&] { return verdict().state == library::TrialState::Bad; }, only_a_hang));
    EXPECT_FALSE(comes_true([&] { return library.take() != nullptr; }, milliseconds(300)));
}

TEST_F(SetSwitching, ATruncatedSetFileChangesNothing) {
    install(put(1, {0}));
    start();
    visit();
    const Bytes good = read_file(folder / library::set_file_name).value();
    ASSERT_TRUE(write_file(folder / library::set_file_name, std::span(good).first(good.size() / 2)));
    ASSERT_TRUE(await([&] { return sets->status() && !sets->status()->trouble.empty(); }));
    EXPECT_EQ(show->set().number, 1U);
    install(put(2, {1}), put(1, {0}));
    EXPECT_TRUE(await_switches(1));
    ASSERT_TRUE(await([&] { return sets->status()->trouble.empty(); }));
}

TEST_F(SetSwitching, FiftySwitchesLeakNoMemory) {
    std::array<library::InstalledSet, 2> both{put(1, {0, 1}), put(2, {2, 3})};
    install(both[0]);
    start();
    visit();
    std::array<std::uint64_t, 2> gpu_bytes{}, loaded_bytes{};
    for (std::uint64_t number = 2; number < 52; ++number) {
        library::InstalledSet& set = both.at(number % 2);
        set.number = number;
        install(set);
        ASSERT_TRUE(await_switches(number - 1)) << number;
        ASSERT_TRUE(await([&] { // its artifacts are loaded, and the old ones are released
            return show->state(shown).loaded == 2 && show->use().gpu_bytes == show->use().planned_gpu_bytes;
        })) << number;
        std::uint64_t& gpu = gpu_bytes.at(number % 2);
        std::uint64_t& loaded = loaded_bytes.at(number % 2);
        gpu = number < 4 ? show->use().gpu_bytes : gpu;
        loaded = number < 4 ? show->state(shown).loaded_bytes : loaded;
        EXPECT_EQ(show->use().gpu_bytes, gpu) << number;
        EXPECT_EQ(show->state(shown).loaded_bytes, loaded) << number;
    }
}

TEST_F(SetSwitching, TheSetsOwnLineReplacesTheInvitation) {
    library::InstalledSet set = put(1, {0});
    set.attract = {{"de", "Bitte anfassen"}, {"en", "Please touch"}};
    install(set);
    start();
    ASSERT_EQ(show->words().size(), 1U);
    EXPECT_EQ(show->words()[0].language, "en");
    ASSERT_EQ(show->words()[0].texts.size(), 1U);
    EXPECT_EQ(show->words()[0].texts[0].key, "attract_line");
    step();
    ASSERT_EQ(shown.state, exhibit::State::Attract);
    rest();
    EXPECT_TRUE(shown.advice);
    EXPECT_EQ(show->use().gpu_bytes, show->use().planned_gpu_bytes);
}

} // namespace
} // namespace frustumscreen::synthetic
