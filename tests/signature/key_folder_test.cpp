// Public keys as files in a folder.
#include "app/pack/signature/key_folder.h"
#include "tests/base/temporary_folder.h"
#include "tests/signature/signature_testing.h"
#include "tests/signature/vectors.h"

#include <filesystem>

namespace frustumscreen::pack {
namespace {

namespace fs = std::filesystem;

class KeyFolder : public WithTemporaryFolder {
protected:
    void expect_refused(const std::string& words) const {
        const auto keys = read_key_folder(folder);
        ASSERT_FALSE(keys) << words;
        EXPECT_TRUE(samples::is_one_line(keys.error().message));
        EXPECT_NE(keys.error().message.find(words), std::string::npos) << keys.error().message;
    }
};

TEST_F(KeyFolder, NamesKeysAfterTheirFiles) {
    EXPECT_TRUE(read_key_folder(folder)->empty());
    put("b.pub", vectors::open_public);
    put("a museum.pub", vectors::encrypted_public);
    put("b.key", vectors::open_key);
    put(".hidden.pub", "nothing");
    put("notes.txt", "nothing");
    const auto keys = read_key_folder(folder);
    ASSERT_TRUE(keys) << keys.error().message;
    ASSERT_EQ(keys->size(), 2U);
    EXPECT_EQ((*keys)[0],
              (TrustedKey{"a museum", *parse_public_key(vectors::encrypted_public), std::nullopt}));
    EXPECT_EQ((*keys)[1], (TrustedKey{"b", *parse_public_key(vectors::open_public), std::nullopt}));
}

TEST_F(KeyFolder, RejectsUnreadableKeysAndFolders) {
    put("bad.pub", "hello\n");
    expect_refused("bad.pub: this is not a minisign public key");
    fs::remove(folder / "bad.pub");
    fs::create_directory(folder / "folder.pub");
    expect_refused("folder.pub: ");
    fs::remove_all(folder);
    expect_refused(folder.string() + ": the folder of public keys cannot be read");
}

TEST_F(KeyFolder, LimitsTheNumberOfKeys) {
    for (std::size_t k = 0; k < max_trusted_keys; ++k) {
        put(fmt::format("{:02}.pub", k), vectors::open_public);
    }
    EXPECT_EQ(read_key_folder(folder)->size(), max_trusted_keys);
    put("more.pub", vectors::open_public);
    expect_refused("more than 32 public keys");
}

} // namespace
} // namespace frustumscreen::pack
