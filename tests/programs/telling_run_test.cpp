// `frustumscreen run` narrates an artifact: its description is in sound.wav, and its text on the table at that time.

#include "app/image/image.h"
#include "app/pack/pack_texts.h"
#include "firmware_host/sound/opus_reader.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstring>

namespace frustumscreen::synthetic {
namespace {

constexpr int seconds_run = 10;
constexpr double asked_at_s = 3.0;

class NarrationRun : public KioskFolder {
protected:
    void SetUp() override {
        KioskFolder::SetUp();
        opus_ = read_file(source_dir() + "/tests/sound/fixtures/speech.opus").value_or(Bytes());
        std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < 20 * seconds_run; ++k) {
            poses +=
                fmt::format("{},1,0,0.08,0,1,0,0,0,1\n{},2,0,-0.55,0.5,1,0,0,0,1\n", 50'000 * k, 50'000 * k);
        }
        put("poses.csv", poses);
    }
    /// `opus`: recording of the description; none: it is silent.
    void put_pack(const std::string& description, const Bytes& opus) const {
        Result<pack::VerifiedPack> loaded = pack::load_pack(folder / "rings.fspack");
        ASSERT_TRUE(loaded) << loaded.error().message;
        pack::Pack pack = **loaded;
        pack.captions = {{"en", "Rings", "Short."}};
        pack.captions[0].description = description;
        if (!opus.empty()) {
            pack::put_sounds(pack, std::vector<pack::SpokenLanguage>{{"en", {{"description", opus}}}});
        }
        const Result<Bytes> bytes = pack::write_pack(pack);
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(write_file(folder / "told.fspack", *bytes));
    }
    void run() const {
        const std::string settings =
            fmt::format("[projector]\nwidth = 640\nheight = 400\nthrow_ratio = 1.875\nrefresh_hz = 20.0\n"
                        "[tracker]\nkind = \"replay\"\nposes = \"poses.csv\"\n"
                        "[panel]\nscript = [{{ at_s = {}, button = 4 }}]\n"
                        "[exhibit]\npacks = [\"told.fspack\"]\nguidance = false\nzone_frame = false\n",
                        asked_at_s);
        put("kiosk.toml", settings);
        ASSERT_EQ(
            shell(fmt::format("'{}/frustumscreen' run --config kiosk.toml --headless --fast --seconds {} "
                              "--stills {} --out pictures >out.txt 2>err.txt",
                              bin_dir(), seconds_run, seconds_run)),
            0)
            << text("err.txt");
    }
    [[nodiscard]] std::vector<std::int16_t> heard() const {
        constexpr std::size_t header = 44;
        const Bytes wav = read_file(folder / "pictures/sound.wav").value_or(Bytes(header));
        std::vector<std::int16_t> samples((wav.size() - header) / sizeof(std::int16_t));
        std::memcpy(samples.data(), wav.data() + header, samples.size() * sizeof(std::int16_t));
        return samples;
    }
    /// Number of pixels brighter than half below the prop's middle, where the caption lies.
    [[nodiscard]] long light_in(int still) const {
        const Result<Bytes> file = read_file(folder / fmt::format("pictures/frame_{:05}.png", still));
        const Result<image::Image8> picture = image::decode_png8(*file);
        EXPECT_TRUE(picture);
        long count = 0;
        for (int y = 280; y < picture->height; ++y) {
            for (int x = 0; x < picture->width; ++x) {
                count += picture->at(x, y).g > 100 ? 1 : 0;
            }
        }
        return count;
    }
    Bytes opus_;
};

/// The lag at which `truth` correlates best with `heard`, and the correlation there.
std::pair<std::size_t, double> best_match(const std::vector<std::int16_t>& heard,
                                          const std::vector<std::int16_t>& truth) {
    constexpr std::size_t step = 7; // every seventh sample is enough
    std::pair<std::size_t, double> best{0, -1.0};
    for (std::size_t lag = 0; lag + truth.size() <= heard.size(); ++lag) {
        double both = 0.0;
        double a = 0.0;
        double b = 0.0;
        for (std::size_t k = 0; k < truth.size(); k += step * 41) {
            both += static_cast<double>(heard[lag + k]) * truth[k];
            a += static_cast<double>(heard[lag + k]) * heard[lag + k];
            b += static_cast<double>(truth[k]) * truth[k];
        }
        const double correlation = a > 0.0 && b > 0.0 ? both / std::sqrt(a * b) : 0.0;
        best = correlation > best.second ? std::pair{lag, correlation} : best;
    }
    return best;
}

const std::string long_text =
    "A description that is several times as long as the short text of its artifact. It "
    "says what there is to see of these rings, one after the other.";

TEST_F(NarrationRun, SpeaksTheDescriptionAndShowsItsText) {
    put_pack(long_text, opus_);
    run();
    const std::vector<std::int16_t> truth = sound::read_opus(opus_)->samples;
    const auto [lag, correlation] = best_match(heard(), truth);
    EXPECT_GT(correlation, 0.99);
    EXPECT_NEAR(static_cast<double>(lag) / sound::sample_rate_hz, asked_at_s, 0.150);
    // Stills are taken in the middle of each second, or shortly afterwards.
    EXPECT_GT(light_in(2), 20) << "the short text";
    const long described = light_in(3);
    EXPECT_GT(described, 3 * light_in(2));
    EXPECT_LT(light_in(9), described / 2) << "the short text again";
    const std::string frames(text("pictures/frames.csv"));
    EXPECT_NE(frames.find(",describe,en,description.0,"), std::string::npos);
}

TEST_F(NarrationRun, ReportsADamagedRecordingAndShowsItsText) {
    Bytes damaged = opus_;
    damaged.resize(60);
    put_pack(long_text, damaged);
    run();
    const std::string errors = text("err.txt");
    const std::string_view silent = "the description in 'en' is silent: ";
    ASSERT_NE(errors.find(silent), std::string::npos) << errors;
    EXPECT_EQ(errors.find(silent), errors.rfind(silent)) << errors;
    EXPECT_GT(light_in(4), 3 * light_in(2));
    const std::vector<std::int16_t> sound = heard();
    EXPECT_TRUE(std::all_of(sound.begin(), sound.end(), [](std::int16_t s) { return s == 0; }));
}

} // namespace
} // namespace frustumscreen::synthetic
