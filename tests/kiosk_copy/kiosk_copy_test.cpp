// The file of a kiosk's copy: what is written is read alike, and nothing else is taken.
#include "app/pack/container/zip_archive.h"
#include "firmware_host/base/calendar_day.h"
#include "tests/kiosk_copy/copies.h"

#include <gtest/gtest.h>

namespace frustumscreen::kiosk_copy {
namespace {

using namespace testing_copy;
using pack::Packing;
using Files = std::vector<std::pair<std::string, std::string>>;

const std::string format_line = "FrustumScreen kiosk copy 1\n";

KioskCopy whole() {
    return {"[table]\nwidth_m = 0.7\n",
            settings::calibration_text(calibration(9)),
            {day(first_day, 3), day(first_day + std::chrono::days(1), 5)}};
}

Bytes archive(const Files& files) {
    pack::ZipWriter zip;
    for (const auto& [name, text] : files) {
        zip.add(name, as_bytes(text), Packing::Deflated);
    }
    return zip.finish().value();
}

std::string id_of(const Bytes& bytes) {
    const Result<KioskCopy> copy = parse_kiosk_copy(bytes);
    EXPECT_FALSE(copy);
    EXPECT_EQ(copy ? std::string::npos : copy.error().message.find('\n'), std::string::npos);
    return copy ? "" : std::string(copy.error().id.view());
}

TEST(KioskCopy, RoundTrip) {
    const KioskCopy copy = whole();
    const Result<Bytes> bytes = write_kiosk_copy(copy);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, write_kiosk_copy(copy).value());
    const Result<KioskCopy> read = parse_kiosk_copy(*bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->settings, copy.settings);
    EXPECT_EQ(read->calibration, copy.calibration);
    EXPECT_EQ(read->days, copy.days);
}

TEST(KioskCopy, ContainsOnlyTheRequestedParts) {
    KioskCopy copy;
    copy.calibration = settings::calibration_text(calibration(9));
    const Result<KioskCopy> read = parse_kiosk_copy(write_kiosk_copy(copy).value());
    ASSERT_TRUE(read);
    EXPECT_FALSE(read->settings);
    EXPECT_TRUE(read->calibration);
    EXPECT_TRUE(read->days.empty());
}

TEST(KioskCopy, FourHundredDaysFit) {
    KioskCopy copy = whole();
    copy.days.clear();
    for (int k = 0; k < 400; ++k) {
        counts::DayCounts& counts = copy.days.emplace_back(day(first_day + std::chrono::days(k), 1));
        counts.artifacts.clear();
        for (int name = 0; name < 60; ++name) {
            counts.artifacts[fmt::format("Amphora of the museum, number {}", name)] = {1, 1000};
        }
    }
    const Result<Bytes> bytes = write_kiosk_copy(copy);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(parse_kiosk_copy(*bytes)->days, copy.days);
}

TEST(KioskCopy, RejectsOtherArchivesAndOversizedFiles) {
    EXPECT_NE(id_of({}), "");
    EXPECT_EQ(id_of(archive({{"kiosk.toml", "[table]\n"}})), "kiosk_copy.format");
    EXPECT_EQ(id_of(archive({{"format.txt", "FrustumScreen kiosk copy 2\n"}})), "kiosk_copy.format");
    for (const char* name : {"../kiosk.toml", "counts/", "counts/2024-02-30.json", "counts/undated.json",
                             "packs/a.fspack", "/etc/passwd", ""}) {
        EXPECT_NE(id_of(archive({{"format.txt", format_line}, {name, "{}"}})), "") << name;
    }
    EXPECT_EQ(
        id_of(archive({{"format.txt", format_line}, {"kiosk.toml", std::string((64U << 10U) + 1, '#')}})),
        "kiosk_copy.size");
    // A thousand zero bytes become one byte in the archive.
    Files bomb{{"format.txt", format_line}};
    for (int k = 0; k < 20; ++k) {
        bomb.emplace_back(fmt::format("counts/{}.json", text_of_day(first_day + std::chrono::days(k))),
                          std::string(1U << 20U, ' '));
    }
    EXPECT_EQ(id_of(archive(bomb)), "kiosk_copy.size");
}

TEST(KioskCopy, RejectsInvalidContents) {
    EXPECT_NE(id_of(archive({{"format.txt", format_line}, {"kiosk.toml", "[table]\nwidht_m = 0.7\n"}})), "");
    EXPECT_NE(id_of(archive({{"format.txt", format_line}, {"calibration.toml", "version = 1\n"}})), "");
    EXPECT_NE(id_of(archive({{"format.txt", format_line}, {"counts/2024-10-04.json", "{}"}})), "");
    const std::string day_text = counts::write_day_counts(day(first_day, 3));
    EXPECT_EQ(id_of(archive({{"format.txt", format_line}, {"counts/2020-01-01.json", day_text}})),
              "kiosk_copy.day");
}

TEST(KioskCopy, RejectsTruncatedFilesAndMostChangedBytes) {
    const Bytes bytes = write_kiosk_copy(whole()).value();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_FALSE(parse_kiosk_copy(std::span(bytes).first(size))) << size;
    }
    const KioskCopy copy = whole();
    int refused = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        Bytes changed = bytes;
        changed[k] ^= std::byte{0x20};
        const Result<KioskCopy> read = parse_kiosk_copy(changed);
        refused += read ? 0 : 1;
        EXPECT_TRUE(!read || (read->settings == copy.settings && read->days == copy.days)) << k;
    }
    EXPECT_GT(refused, static_cast<int>(bytes.size() / 2));
}

} // namespace
} // namespace frustumscreen::kiosk_copy
