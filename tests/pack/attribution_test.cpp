// Visitors' attribution lines for an artifact and its scan, and the statements that a pack should have.
#include "app/pack/attribution.h"
#include "app/pack/pack_file.h"
#include "tests/pack/samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::pack {
namespace {

PackCaption caption_of(std::string maker, std::string place, std::string period, std::string credit) {
    PackCaption caption{"en", "Jar", "A jar."};
    caption.maker = std::move(maker);
    caption.place = std::move(place);
    caption.period = std::move(period);
    caption.credit = std::move(credit);
    return caption;
}

TEST(Attribution, HasALineForTheArtifactOneForItsOwnerAndOneForTheScan) {
    const PackCaption all = caption_of("Exekias", "Athens", "about 540 BC", "Gift of Ann Lee, 1921");
    const ScanRights rights{"CC-BY-4.0", "Jo Fox", "https://example.org/jar"};
    EXPECT_EQ(
        attribution_of(all, rights),
        "Exekias \u00B7 Athens \u00B7 about 540 BC\nGift of Ann Lee, 1921\n3D: Jo Fox \u00B7 CC-BY-4.0");
    EXPECT_EQ(attribution_of(caption_of("", "Athens", "", ""), {}), "Athens");
    EXPECT_EQ(attribution_of(caption_of("", "", "", "Gift"), {"CC0-1.0", {}, {}}), "Gift\n3D: CC0-1.0");
    EXPECT_EQ(attribution_of(caption_of("", "", "", ""), {{}, {}, "https://example.org"}), "");
}

TEST(Attribution, PrintsALicenceOnceAndAddressesAsHosts) {
    EXPECT_EQ(attribution_of(caption_of("", "", "", "Museum, CC-BY-4.0"), {"CC-BY-4.0", {}, {}}),
              "Museum, CC-BY-4.0");
    // The form in which Sketchfab writes them.
    EXPECT_EQ(
        attribution_of(caption_of("", "", "", ""), {"CC-BY-4.0 (http://creativecommons.org/licenses/by/4.0/)",
                                                    "Ankledot (https://sketchfab.com/Ankledot)",
                                                    {}}),
        "3D: Ankledot (sketchfab.com) \u00B7 CC-BY-4.0");
    EXPECT_EQ(with_short_addresses("by A https://www.example.org/x?y=1 and http://b.net#z, c"),
              "by A example.org and b.net c");
    EXPECT_EQ(with_short_addresses("https://"), "");
    EXPECT_EQ(with_short_addresses("a http: //b"), "a http: //b");
}

TEST(Attribution, RoundTripsThroughASectionOfThePack) {
    Pack pack = samples::pack();
    const ScanRights rights{"CC-BY-4.0", "Jo Fox", "https://example.org/jar"};
    put_scan_rights(pack, rights);
    const VerifiedPack read = verify_pack(write_pack(pack).value()).value();
    EXPECT_EQ(scan_rights(*read).value(), rights);
    ASSERT_EQ(std::count_if(read->sections.begin(), read->sections.end(),
                            [](const PackSection& section) { return section.name == "attribution"; }),
              1);
    Pack plain = samples::pack();
    const std::size_t sections = plain.sections.size();
    put_scan_rights(plain, {"CC0-1.0", {}, {}});
    EXPECT_EQ(plain.sections.size(), sections) << "a licence alone has its place in the manifest";
    EXPECT_EQ(scan_rights(plain).value(), (ScanRights{"CC0-1.0", {}, {}}));
}

TEST(Attribution, RejectsAMalformedSection) {
    for (const char* data :
         {R"({"author":"a"})", R"({"author":"a","source":1})", R"({"author":"a","source":"b","more":""})",
          R"({"author":"two\nlines","source":""})", R"({"author":"","source":"\u202e"})"}) {
        PackDescription pack;
        pack.sections.push_back({"attribution", data, {}});
        EXPECT_FALSE(scan_rights(pack)) << data;
    }
    PackDescription with_part;
    with_part.sections.push_back({"attribution", R"({"author":"a","source":""})", {"attribution/a"}});
    EXPECT_FALSE(scan_rights(with_part));
}

TEST(Attribution, ReportsMissingLicenceAuthorAndId) {
    const auto missing = [](const std::string& licence, const std::string& author,
                            const std::string& credit) {
        PackDescription pack;
        pack.id = "jar";
        pack.captions = {caption_of("", "", "", credit)};
        return missing_in(pack, {licence, author, {}}).size();
    };
    EXPECT_EQ(missing("", "", ""), 1U);
    EXPECT_EQ(missing("CC-BY-4.0", "", ""), 1U);
    EXPECT_EQ(missing("cc by-sa 4.0", "", ""), 1U);
    EXPECT_EQ(missing("CC-BY-4.0", "Ann", ""), 0U);
    EXPECT_EQ(missing("CC-BY-4.0", "", "Scan: Ann"), 0U);
    EXPECT_EQ(missing("CC0-1.0", "", ""), 0U);
    EXPECT_EQ(missing("all rights reserved", "", ""), 0U);
    PackDescription nameless;
    EXPECT_EQ(missing_in(nameless, {"CC0-1.0", {}, {}}).size(), 1U) << "it has no id";
}

} // namespace
} // namespace frustumscreen::pack
