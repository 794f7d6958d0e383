/// Thousands of damaged models: each is refused in one line or loads as a valid mesh; none crashes or hangs.
#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_models.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <random>

namespace frustumscreen::testing {
namespace {

class Mutator {
public:
    explicit Mutator(std::uint32_t seed) : random_(seed) {}

    std::string mutated(std::string bytes) {
        const int changes = 1 + below(3);
        for (int i = 0; i < changes && !bytes.empty(); ++i) {
            change(bytes);
        }
        return bytes;
    }

private:
    int below(std::size_t limit) { return static_cast<int>(random_() % limit); }
    std::size_t place(const std::string& bytes) { return random_() % bytes.size(); }

    void change(std::string& bytes) {
        switch (below(8)) {
        case 0:
            bytes[place(bytes)] = static_cast<char>(random_());
            break;
        case 1:
            bytes[place(bytes)] ^= static_cast<char>(1 << below(8));
            break;
        case 2:
            bytes.resize(place(bytes));
            break;
        case 3:
            bytes.erase(place(bytes), static_cast<std::size_t>(1 + below(16)));
            break;
        case 4:
            bytes.insert(place(bytes), bytes.substr(place(bytes), static_cast<std::size_t>(1 + below(32))));
            break;
        case 5:
            overwrite_word(bytes);
            break;
        default:
            replace_number(bytes);
        }
    }

    /// Lengths and counts of binary formats are 32-bit words, mostly at multiples of four.
    void overwrite_word(std::string& bytes) {
        static constexpr std::array<std::uint32_t, 8> words = {0,          1,          0xffffffff, 0x7fffffff,
                                                               0x80000000, 0x7fc00000, 0x7f800000, 1000000};
        const std::size_t at = place(bytes) / 4 * 4;
        const std::string word = bytes_of(std::vector{words[static_cast<std::size_t>(below(words.size()))]});
        bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at), word);
    }

    /// Replaces the digits around a random place, if there are any.
    void replace_number(std::string& bytes) {
        static constexpr std::array<std::string_view, 14> numbers = {
            "0",    "-1",    "3",    "255", "65536", "4294967295", "4294967296", "99999999999999999999",
            "1e30", "1e999", "-0.5", "nan", "\"x\"", "[]"};
        const std::string_view digits = "0123456789.+-e";
        const std::size_t some = bytes.find_first_of("0123456789", place(bytes));
        if (some == std::string::npos) {
            return;
        }
        const std::size_t end = std::min(bytes.find_first_not_of(digits, some), bytes.size());
        bytes.replace(some, end - some, numbers[static_cast<std::size_t>(below(numbers.size()))]);
    }

    std::mt19937 random_;
};

TEST(Mutation, UnchangedSamplesLoad) {
    for (const SampleModel& model : sample_models()) {
        const Result<bake::SourceMesh> mesh = load_text(model.name, model.bytes);
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
    }
}

TEST(Mutation, DamagedModelsAreRejectedInOneLineOrSound) {
    constexpr int mutants = 8000;
    const std::vector<SampleModel> models = sample_models();
    Mutator mutator(20240607);
    int loaded = 0;
    for (int i = 0; i < mutants; ++i) {
        const SampleModel& model = models[static_cast<std::size_t>(i) % models.size()];
        const std::string bytes = mutator.mutated(model.bytes);
        SCOPED_TRACE("mutant " + std::to_string(i) + " of " + model.name);
        const auto begin = std::chrono::steady_clock::now();
        const Result<bake::SourceMesh> mesh = load_text(model.name, bytes);
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
        if (mesh) {
            expect_sound(*mesh);
            EXPECT_LT(mesh->positions.size(), 100'000U) << "more than such a file can back with data";
            ++loaded;
        } else {
            EXPECT_EQ(mesh.error().message.find_first_of("\r\n"), std::string::npos);
            EXPECT_EQ(mesh.error().message.find("nowhere/" + model.name + ": "), 0U) << mesh.error().message;
            EXPECT_GT(mesh.error().message.size(), model.name.size() + 16);
        }
        if (::testing::Test::HasFailure()) {
            std::ofstream(model.name, std::ios::binary) << bytes;
            FAIL() << "the mutant is kept as " << model.name;
        }
    }
    EXPECT_GT(loaded, mutants / 20) << "most mutants die at the door: the patterns are damaged too much";
    EXPECT_LT(loaded, mutants) << "no mutant was refused: the patterns are not damaged at all";
}

} // namespace
} // namespace frustumscreen::testing
