/// Seeded mutations of the shipped settings: each is accepted, or refused in one line.
#include "tests/settings/settings_text.h"

#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::settings {
namespace {

constexpr int mutants = 3000;

class Mutator {
public:
    explicit Mutator(unsigned seed) : engine_(seed) {}

    std::string mutate(std::string text) {
        const std::size_t changes = 1 + below(3);
        for (std::size_t k = 0; k < changes && !text.empty(); ++k) {
            change(text);
        }
        return text;
    }

private:
    std::size_t below(std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(engine_);
    }

    void change(std::string& text) {
        static const std::array<std::string, 24> tokens{"nan",
                                                        "-inf",
                                                        "1e999",
                                                        "-0.0",
                                                        "99999999999999999999",
                                                        "[",
                                                        "]]",
                                                        "{",
                                                        "\"",
                                                        "'''",
                                                        "= =",
                                                        "\n",
                                                        "\xff",
                                                        "\xef\xbb\xbf",
                                                        "[prop]\n",
                                                        "true",
                                                        "[[",
                                                        ".",
                                                        "1979-05-27",
                                                        "\"\"\"",
                                                        "0x7fffffffffffffff",
                                                        "a.b.c=1\n",
                                                        "\r\n",
                                                        std::string(1, '\0')};
        const std::size_t at = below(text.size());
        switch (below(6)) {
        case 0:
            text[at] = static_cast<char>(below(256));
            break;
        case 1:
            text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            break;
        case 2:
            text.erase(at, 1 + below(20));
            break;
        case 3:
            text.insert(at, tokens[below(tokens.size())]);
            break;
        case 4:
            text.insert(below(text.size()), text.substr(at, 1 + below(60)));
            break;
        default:
            replace_a_number(text, at);
        }
    }

    void replace_a_number(std::string& text, std::size_t from) {
        constexpr std::string_view in_number = "0123456789.-";
        const std::size_t begin = text.find_first_of("0123456789", from);
        if (begin == std::string::npos) {
            return;
        }
        const std::size_t end = std::min(text.find_first_not_of(in_number, begin), text.size());
        const double magnitude = std::pow(10.0, static_cast<double>(below(40)) - 20.0);
        text.replace(begin, end - begin, (below(2) == 0 ? "-" : "") + std::to_string(magnitude));
    }

    std::mt19937 engine_;
};

bool finite(const Settings& s) {
    const geometry::Pinhole& p = s.projector.pinhole;
    const glm::dmat4 pose = s.projector.table_from_projector.matrix();
    double sum = p.fx + p.fy + p.cx + p.cy + s.prop.base_m + s.prop.top_m + s.prop.height_m +
                 s.table.width_m + s.table.depth_m + s.eye.default_m.x + s.eye.default_m.y +
                 s.eye.default_m.z + s.panel.repeat_s;
    for (int k = 0; k < 16; ++k) {
        sum += pose[k / 4][k % 4];
    }
    return std::isfinite(sum);
}

TEST(Mutations, AreAcceptedOrRefusedInOneLine) {
    const std::string shipped = shipped_text();
    Mutator mutator(20);
    int taken = 0;
    int located = 0;
    for (int k = 0; k < mutants; ++k) {
        const std::string mutant = mutator.mutate(shipped);
        const auto settings = parse_settings(mutant, "kiosk.toml");
        if (settings) {
            ++taken;
            EXPECT_TRUE(finite(**settings));
            continue;
        }
        const std::string& message = settings.error().message;
        EXPECT_EQ(message.rfind("kiosk.toml:", 0), 0U) << message;
        EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
        EXPECT_LT(message.size(), 500U) << message;
        located += message.find_first_of("0123456789") == std::string("kiosk.toml:").size() ? 1 : 0;
    }
    EXPECT_GT(taken, mutants / 10);
    EXPECT_GT(located, mutants / 3);
    EXPECT_GE(located, (mutants - taken) * 95 / 100);
}

TEST(Mutations, DeepNestingIsRefused) {
    for (const std::string open : {"[", "{a="}) {
        std::string text = "x = ";
        for (int k = 0; k < 100000; ++k) {
            text += open;
        }
        EXPECT_FALSE(refusal(text).empty());
    }
    for (const int dots : {4900, 100000}) {
        std::string keys = "a";
        for (int k = 0; k < dots; ++k) {
            keys += ".a";
        }
        EXPECT_FALSE(refusal(keys + " = 1").empty());
        EXPECT_FALSE(refusal("[" + keys + "]").empty());
    }
}

} // namespace
} // namespace frustumscreen::settings
