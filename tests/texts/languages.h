// A line in each script that the exhibit must typeset, with joins, marks and both directions.
#pragma once

#include "assets_baked/texts/shape.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace frustumscreen::testing {

struct Sample {
    const char* language;
    const char* text;
};

inline constexpr auto samples = std::to_array<Sample>({
    {"en", "The amphora carries 39 litres; affine flourishes \xe2\x80\x94 AVATAR."},
    {"de", "Schieben Sie den weißen Block über die Tischfläche."},
    {"el", "Ο αμφορέας χωράει τριάντα εννέα λίτρα: Ἀθήνησιν."},
    {"ar", "حرّك المجسّم الأبيض على الطاولة، سنة 1923."},
    {"he", "הזיזו את הגוף הלבן על השולחן (USB) 1923."},
    {"hi", "सफ़ेद ब्लॉक को मेज़ पर खिसकाइए। क्षत्रिय श्री"},
    {"th", "เลื่อนบล็อกสีขาวบนโต๊ะแล้วมองเข้าไปข้างใน"},
    {"ja", "白いブロックを回して、中の壺をご覧ください。"},
    {"zh", "请移动白色方块，图片里的瓷器年代很久。"},
});

/// A shaper, and whether a language's typeface is installed; a test skips the others and reports them.
class Shaping : public ::testing::Test {
protected:
    void SetUp() override {
        Result<texts::Shaper> opened = texts::Shaper::open();
        ASSERT_TRUE(opened) << opened.error().message;
        shaper.emplace(*std::move(opened));
    }
    [[nodiscard]] bool has(const std::string& language) {
        const Result<void> there = shaper->fonts().check(language);
        if (!there) {
            skipped += (skipped.empty() ? "" : "; ") + there.error().message;
        }
        return there.has_value();
    }
    void TearDown() override {
        if (!skipped.empty() && !HasFailure()) {
            GTEST_SKIP() << skipped;
        }
    }
    [[nodiscard]] Result<texts::ShapedText> shape(const std::string& language, const std::string& text,
                                                  int width_em = 200, bool bold = false) {
        return shaper->shape({text, language, {width_em * pack::em_units}, bold});
    }

    std::optional<texts::Shaper> shaper;
    std::string skipped;
};

} // namespace frustumscreen::testing
