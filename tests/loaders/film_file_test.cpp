// Films as files: animations made byte by byte as the format's page has them, and folders of pictures.
#include "assets_baked/bake/loaders/film_file.h"
#include "firmware_host/base/file.h"
#include "tests/base/told.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::bake {

namespace {

namespace fs = std::filesystem;
constexpr FilmLimits limits{.min_side = 8, .max_side = 64, .max_frames = 600};

image::Image8 picture(int width, int height, int seed) {
    image::Image8 made(width, height);
    for (std::size_t k = 0; k < made.texels.size(); ++k) {
        made.texels[k] = {(40 * seed) & 255, k & 255U, (k * 7) & 255U, 255};
    }
    return made;
}

std::string three_bytes(std::size_t value) {
    return {static_cast<char>(value & 255U), static_cast<char>(value >> 8 & 255U),
            static_cast<char>(value >> 16 & 255U)};
}
std::string four_bytes(std::size_t value) {
    return three_bytes(value) + static_cast<char>(value >> 24 & 255U);
}
std::string chunk(const std::string& name, const std::string& data) {
    return name + four_bytes(data.size()) + data + (data.size() % 2 != 0 ? std::string(1, '\0') : "");
}

/// RIFF container specification, "Animation": VP8X, ANIM, then one ANMF for each frame.
std::string animation(const std::vector<image::Image8>& frames, const std::vector<int>& durations_ms) {
    const glm::ivec2 size(frames.front().width, frames.front().height);
    const std::string extent =
        three_bytes(static_cast<std::size_t>(size.x - 1)) + three_bytes(static_cast<std::size_t>(size.y - 1));
    std::string body =
        "WEBP" + chunk("VP8X", std::string("\x02\0\0\0", 4) + extent) + chunk("ANIM", std::string(6, '\0'));
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const Bytes still = image::encode_webp(frames[k]);
        const std::string bitstream(as_text(still).substr(12)); // behind RIFF, size, WEBP
        body += chunk("ANMF", std::string(6, '\0') + extent +
                                  three_bytes(static_cast<std::size_t>(durations_ms[k])) +
                                  std::string(1, '\x02') + bitstream);
    }
    return "RIFF" + four_bytes(body.size()) + body;
}

class FilmFile : public testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    [[nodiscard]] fs::path put(const std::string& name, std::string_view bytes) const {
        EXPECT_TRUE(write_file(folder / name, as_bytes(bytes)));
        return folder / name;
    }
    void put_picture(const std::string& name, const image::Image8& image) const {
        fs::create_directories((folder / name).parent_path());
        EXPECT_TRUE(write_file(folder / name, image::encode_png(image)));
    }
    [[nodiscard]] static std::string refusal(const fs::path& film) {
        const Result<void> read = read_film(film, limits, [](image::Image8) {});
        return read ? std::string() : test::told(read.error());
    }
    [[nodiscard]] static std::vector<image::Image8> frames_of(const fs::path& film) {
        std::vector<image::Image8> frames;
        const Result<void> read =
            read_film(film, limits, [&](image::Image8 frame) { frames.push_back(std::move(frame)); });
        EXPECT_TRUE(read) << (read ? "" : read.error().message);
        return frames;
    }

    const fs::path folder = "film_file_test";
};

TEST_F(FilmFile, reads_frames_and_rate_of_an_animation) {
    const std::vector<image::Image8> frames{picture(16, 8, 1), picture(16, 8, 2), picture(16, 8, 3)};
    const fs::path film = put("growth.webp", animation(frames, {80, 80, 80}));
    const Result<FilmOutline> outline = outline_of_film(film, limits);
    ASSERT_TRUE(outline) << outline.error().message;
    EXPECT_EQ(outline->frames, 3U);
    EXPECT_EQ(outline->width, 16);
    EXPECT_EQ(outline->height, 8);
    EXPECT_EQ(outline->rate_hz, 12.5);
    EXPECT_TRUE(outline->is_even);
    const std::vector<image::Image8> read = frames_of(film);
    ASSERT_EQ(read.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(read[k].texels, frames[k].texels) << k;
    }
    const fs::path uneven = put("uneven.webp", animation(frames, {50, 100, 250}));
    EXPECT_FALSE(outline_of_film(uneven, limits)->is_even);
    EXPECT_EQ(outline_of_film(uneven, limits)->rate_hz, 7.5);
}

TEST_F(FilmFile, sorts_pictures_of_a_folder_by_number) {
    for (const int number : {10, 9, 1}) {
        put_picture(fmt::format("frames/f{}.png", number), picture(8, 8, number));
    }
    put_picture("frames/f2.jpeg-is-png", picture(8, 8, 2));
    const std::vector<image::Image8> all = frames_of(folder / "frames");
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[1].texels, picture(8, 8, 2).texels);
    EXPECT_EQ(all[3].texels, picture(8, 8, 10).texels);
    const std::vector<image::Image8> some = frames_of(folder / "frames/f*.png");
    ASSERT_EQ(some.size(), 3U);
    EXPECT_EQ(some[1].texels, picture(8, 8, 9).texels);
    EXPECT_EQ(outline_of_film(folder / "frames", limits)->rate_hz, std::nullopt);
}

TEST_F(FilmFile, rejects_invalid_films_in_one_line) {
    const std::vector<image::Image8> two{picture(16, 8, 1), picture(16, 8, 2)};
    const std::string good = animation(two, {40, 40});
    ASSERT_EQ(refusal(put("good.webp", good)), "");
    put_picture("one/a.png", picture(8, 8, 1));
    put_picture("mixed/a.png", picture(8, 8, 1));
    put_picture("mixed/b.png", picture(16, 8, 1));
    put_picture("large/a.png", picture(65, 8, 1));
    put_picture("large/b.png", picture(65, 8, 1));
    put_picture("small/a.png", picture(1, 1, 1));
    put_picture("small/b.png", picture(1, 1, 1));
    fs::create_directories(folder / "empty");
    const std::vector<image::Image8> many(601, picture(8, 8, 1));
    const std::string huge =
        "RIFF" + four_bytes(30) + "WEBP" +
        chunk("VP8X", std::string("\x02\0\0\0", 4) + three_bytes(16383) + three_bytes(16383));
    const std::vector<std::pair<fs::path, std::vector<std::string>>> faults{
        {put("many.webp", animation(many, std::vector<int>(many.size(), 40))), {"601 frames", "600"}},
        {put("one.webp", animation({picture(8, 8, 1)}, {40})), {"1 frame;", "picture ="}},
        {put("large.webp", animation({picture(65, 8, 1), picture(65, 8, 2)}, {40, 40})), {"65 x 8", "64"}},
        {put("cut.webp", good.substr(0, good.size() - 20)), {"cut.webp", "damaged"}},
        {put("damaged.webp", good.substr(0, 60) + std::string(good.size() - 60, 'x')), {"damaged"}},
        {put("huge.webp", huge), {"huge.webp"}},
        {put("still.webp", as_text(image::encode_webp(picture(8, 8, 1)))), {"1 frame;"}},
        {put("text.webp", "no picture"), {"[film.no_film]"}},
        {folder / "nothing.webp", {"nothing.webp"}},
        {folder / "empty", {"[film.no_pictures]"}},
        {folder / "x*.png", {"[film.no_pictures]"}},
        {folder / "one", {"1 frame;"}},
        {folder / "mixed", {"[film.other_size]", "16 x 8"}},
        {folder / "large", {"65 x 8"}},
        {folder / "small", {"1 x 1", "8 to 64"}},
    };
    for (const auto& [film, words] : faults) {
        const std::string told = refusal(film);
        EXPECT_EQ(told.find('\n'), std::string::npos) << told;
        for (const std::string& word : words) {
            EXPECT_NE(told.find(word), std::string::npos) << film << " " << word << ": " << told;
        }
        EXPECT_FALSE(outline_of_film(film, limits) && film != folder / "mixed" &&
                     film != folder / "cut.webp" && film != folder / "damaged.webp")
            << film;
    }
}

} // namespace
} // namespace frustumscreen::bake
