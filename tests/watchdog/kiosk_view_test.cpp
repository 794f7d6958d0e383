// A kiosk made of files in a folder: what the watchdog sees of it.
#include "app/programs/watchdog/kiosk_view.h"
#include "firmware_host/base/this_boot.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

class KioskOfFiles : public WithTemporaryFolder {
protected:
    KioskOfFiles() {
        places_.root = folder;
        put("proc/sys/kernel/random/boot_id", "b1\n");
        put("proc/meminfo", "MemTotal:       1000 kB\nMemFree:          10 kB\nMemAvailable:    250 kB\n");
        put("sys/fs/cgroup/system.slice/frustumscreen.service/cgroup.procs", "512\n498\n600\n");
        put("sys/fs/cgroup/system.slice/frustumscreen.service/memory.max", "2000\n");
        put("sys/fs/cgroup/system.slice/frustumscreen.service/memory.stat", "anon 500\nfile 1400\n");
        put("sys/class/drm/card0-HDMI-A-1/status", "disconnected\n");
        put("sys/class/drm/card0-DP-1/status", "connected\n");
        put("sys/class/thermal/thermal_zone0/temp", "45000\n");
        put("sys/class/thermal/thermal_zone1/temp", "71500\n");
        put("sys/block/mmcblk0/device/life_time", "0x02 0x09\n");
        status("b1", 100);
        fs::create_directories(folder / "var/lib/frustumscreen-watchdog");
    }
    void status(const std::string& boot, int written_s) const {
        put(places_.status,
            "{\"boot_id\": \"" + boot + "\", \"monotonic_ns\": " + std::to_string(written_s) +
                "000000000, \"health\": \"well\", \"artifact\": \"A\", \"drawn\": 4, \"probes\": 1}");
    }
    [[nodiscard]] watch::Outcome look(KioskView& view, int now_s = 102) const {
        return view.look(MonotonicTime(seconds(now_s)),
                         std::chrono::sys_days(std::chrono::year{2027} / 1 / 1));
    }

    KioskPlaces places_;
};

TEST_F(KioskOfFiles, ReadsEveryValue) {
    KioskView view(places_, boot_id(folder));
    const watch::Outcome outcome = look(view);
    EXPECT_EQ(outcome.process, 498);
    EXPECT_EQ(outcome.failures, 0U);
    ASSERT_TRUE(outcome.exhibit);
    EXPECT_EQ(outcome.exhibit->age, seconds(2));
    EXPECT_EQ(outcome.exhibit->pictures, 5U);
    EXPECT_NEAR(outcome.memory_free, 0.25, 1e-9);
    EXPECT_NEAR(outcome.exhibit_memory, 0.25, 1e-9);
    EXPECT_NEAR(outcome.disk_worn, 0.9, 1e-9);
    EXPECT_NEAR(outcome.hottest_c.value_or(0.0), 71.5, 1e-9);
    EXPECT_EQ(outcome.projector, true);
    EXPECT_TRUE(outcome.disk_writable);
    EXPECT_TRUE(outcome.clock_plausible);
    EXPECT_FALSE(outcome.safe_pictures);
}

TEST_F(KioskOfFiles, UsesDefaultsWithoutFiles) {
    fs::remove_all(folder);
    KioskView view(places_, boot_id(folder));
    const watch::Outcome outcome = look(view);
    EXPECT_EQ(outcome.process, 0);
    EXPECT_FALSE(outcome.exhibit);
    EXPECT_EQ(outcome.memory_free, 1.0);
    EXPECT_EQ(outcome.exhibit_memory, 0.0);
    EXPECT_FALSE(outcome.projector);
    EXPECT_FALSE(outcome.hottest_c);
    EXPECT_FALSE(view.capabilities().device);
    EXPECT_TRUE(notes_of(outcome).empty());
}

TEST_F(KioskOfFiles, IgnoresAStatusOfAnotherBoot) {
    KioskView view(places_, boot_id(folder));
    status("b0", 100);
    EXPECT_FALSE(look(view).exhibit);
    status("b1", 300); // after now: a clock that is read twice
    EXPECT_EQ(look(view).exhibit->age, seconds(0));
}

TEST_F(KioskOfFiles, CountsEndsOfTheExhibit) {
    KioskView view(places_, boot_id(folder));
    const auto end = [&](const char* text) { std::ofstream(folder / places_.ends, std::ios::app) << text; };
    fs::create_directories((folder / places_.ends).parent_path());
    end("12.5 exit-code exited 1\n13.1 success exited 0\n");
    EXPECT_EQ(look(view).failures, 1U);
    EXPECT_EQ(view.last_end(), "exit-code exited 1");
    end("14.0 watchdog killed");
    EXPECT_EQ(look(view).failures, 1U) << "half a line counts once it is whole";
    end(" KILL\n");
    EXPECT_EQ(look(view).failures, 2U);
    EXPECT_EQ(view.last_end(), "watchdog killed KILL");
    EXPECT_EQ(look(view).failures, 2U);
    std::ofstream(folder / places_.ends) << "1.0 signal killed SEGV\n"; // a new file
    EXPECT_EQ(look(view).failures, 3U);
    std::string many;
    for (int k = 0; k < 5000; ++k) {
        many += "2.0 signal killed SEGV\n";
    }
    end(many.c_str());
    std::uint32_t failures = 0;
    for (int k = 0; k < 3; ++k) {
        failures = look(view).failures;
    }
    EXPECT_EQ(failures, 5003U);
}

TEST_F(KioskOfFiles, DetectsCapabilitiesByTheirFiles) {
    KioskView view(places_, boot_id(folder));
    EXPECT_FALSE(view.capabilities().device);
    EXPECT_FALSE(view.capabilities().last_good_set);
    put(places_.device, "");
    put(places_.last_good, "frustumscreen-set 1 00\n{\"set\": {}, \"last_good\": null}");
    EXPECT_TRUE(view.capabilities().device);
    EXPECT_FALSE(view.capabilities().last_good_set);
    put(places_.last_good, "frustumscreen-set 1 00\n{\"set\": {}, \"last_good\": {\"number\": 2}}");
    EXPECT_TRUE(view.capabilities().last_good_set);
}

TEST_F(KioskOfFiles, WritesANoteForEachProblem) {
    watch::Outcome outcome;
    outcome.projector = false;
    outcome.disk_free = 0.01;
    outcome.disk_worn = 0.9;
    outcome.hottest_c = 95.0;
    outcome.clock_plausible = false;
    EXPECT_EQ(notes_of(outcome).size(), 5U);
    outcome.disk_writable = false;
    EXPECT_EQ(notes_of(outcome).size(), 5U);
}

TEST_F(KioskOfFiles, ReportsWhyTheExhibitEnded) {
    KioskView view(places_, "b1");
    EXPECT_EQ(view.why_it_ended(), "");
    put("run/frustumscreen/ends", "57.90 exit-code exited 1\n");
    static_cast<void>(view.look(MonotonicTime(seconds(100)), {}));
    EXPECT_EQ(view.why_it_ended(), "it ended with an error (exited 1)");
    const std::string crash =
        "frustumscreen-crash-1\nunix_s 1\nmonotonic_ms 90000\nboot b1\nsignal SIGSEGV\nthread "
        "llvmpipe-0\nframe swrast_dri.so+0x12\nend\n";
    put("var/cache/frustumscreen/crashes/crash_2", crash);
    EXPECT_EQ(view.why_it_ended(), "it ended with an error (exited 1)") << "that crash came later";
    put("run/frustumscreen/ends", "57.90 exit-code exited 1\n90.40 core-dump dumped SEGV\n");
    static_cast<void>(view.look(MonotonicTime(seconds(101)), {}));
    EXPECT_EQ(view.why_it_ended(), "SIGSEGV in swrast_dri.so+0x12, thread llvmpipe-0");
    put("var/cache/frustumscreen/crashes/crash_2",
        "frustumscreen-crash-1\nmonotonic_ms 90000\nboot b0\nsignal SIGBUS\n");
    EXPECT_EQ(view.why_it_ended(), "it crashed (dumped SEGV)") << "of another boot";
}

} // namespace
} // namespace frustumscreen::programs
