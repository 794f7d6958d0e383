// The museum's public keys in the settings, and the policy for unsigned packs.
#include "app/settings/config_json.h"
#include "firmware_host/base/json.h"
#include "tests/settings/settings_text.h"

namespace frustumscreen::settings {
namespace {

constexpr std::string_view line =
    "RWSie4mHjLdoDgFygpvWxkFKDOTJgi5VklPjkmLVcy4pfr8p961f7U5V"; // made by minisign 0.11

std::string key_table(const std::string& rest) {
    return "[exhibit]\n[[exhibit.keys]]\n" + rest;
}
std::string with_line(const std::string& before, const std::string& after = {}) {
    return key_table(before + "public_key = \"" + std::string(line) + "\"\n" + after);
}

TEST(Keys, DefaultIsNoKeysAndRefusedUnsignedPacks) {
    EXPECT_TRUE(parsed("").exhibit.keys.empty());
    EXPECT_EQ(parsed("").exhibit.unsigned_packs, pack::UnsignedPacks::Refuse);
    EXPECT_EQ(parsed("[exhibit]\nunsigned = \"allow\"\n").exhibit.unsigned_packs, pack::UnsignedPacks::Allow);
    EXPECT_NE(refusal("[exhibit]\nunsigned = \"yes\"\n")
                  .find("set/kiosk.toml:2: exhibit.unsigned is the text \"yes\""),
              std::string::npos);
}

TEST(Keys, ParsesNameAndOptionalLastDay) {
    const std::string text =
        with_line("name = \"House\"\n", "until = \"2030-12-31\"\n[[exhibit.keys]]\nname = \"Lab\"\n"
                                        "public_key = \"" +
                                            std::string(line) + "\"\n");
    const std::vector<pack::TrustedKey> keys = parsed(text).exhibit.keys;
    ASSERT_EQ(keys.size(), 2U);
    EXPECT_EQ(keys[0].name, "House");
    EXPECT_EQ(pack::public_key_line(keys[0].key), line);
    using std::chrono::year;
    EXPECT_EQ(keys[0].until, std::chrono::sys_days(year(2030) / 12 / 31));
    EXPECT_EQ(keys[1].until, std::nullopt);
    const auto json = nlohmann::json::parse(config_json(*parse_settings(text, "set/kiosk.toml")));
    EXPECT_EQ(json["exhibit"]["keys"][0],
              nlohmann::json({{"name", "House"}, {"public_key", line}, {"until", "2030-12-31"}}));
    EXPECT_EQ(json["exhibit"]["keys"][1]["until"], "");
    EXPECT_EQ(json["exhibit"]["unsigned"], "refuse");
}

TEST(Keys, RefusesInvalidKeysWithTheirLine) {
    const auto expect = [](const std::string& text, const std::string& words) {
        const std::string message = refusal(text);
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    expect(key_table("name = \"House\"\npublic_key = \"RWS\"\n"),
           "set/kiosk.toml:4: exhibit.keys[0].public_key is the text \"RWS\"; allowed are public keys of "
           "minisign");
    expect(key_table("name = \"House\"\n"),
           "exhibit.keys[0].public_key is the text \"\"; allowed are public keys");
    expect(with_line(""), "exhibit.keys[0].name is left out");
    expect(with_line("name = \"House\"\n", "until = \"2030-02-30\"\n"),
           "set/kiosk.toml:5: exhibit.keys[0].until is the text \"2030-02-30\"; allowed are days such as "
           "\"2030-12-31\"");
    expect(with_line("name = \"House\"\n", "until = \"31.12.2030\"\n"), "exhibit.keys[0].until is the text");
    expect(with_line("name = \"House\"\n", "until = 2030-12-31\n"), "exhibit.keys[0].until is a date");
    expect(with_line("name = \"House\"\n", "end = \"2030-12-31\"\n"),
           "exhibit.keys[0].end is not a known key");
    const std::string twice =
        with_line("name = \"House\"\n",
                  "[[exhibit.keys]]\nname = \"House\"\npublic_key = \"" + std::string(line) + "\"\n");
    expect(twice, "exhibit.keys has two keys called \"House\"");
}

} // namespace
} // namespace frustumscreen::settings
