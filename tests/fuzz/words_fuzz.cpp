// A museum's own words: refused in one line, or each has a known key and a text that can be shaped.
#include "assets_baked/texts/check_text.h"
#include "assets_baked/texts/words.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto words = texts::parse_words(fuzz::text_of(data, size), "words/xx.toml");
    if (!words) {
        fuzz::require_one_line(words.error().message);
        return 0;
    }
    for (const auto& [key, text] : *words) {
        fuzz::require(texts::parse_words(key + " = \"a\"", "words/xx.toml").has_value(), "a key is known",
                      key);
        fuzz::require(!text.empty() && texts::check_shaped_text(text).has_value(), "a text can be shaped",
                      text);
    }
    return 0;
}
