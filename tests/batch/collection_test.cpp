// The objects in a folder, a machine's share of them, and the hash of an object's content.
#include "app/programs/batch/collection.h"
#include "app/programs/batch/content_hash.h"
#include "tests/programs/program_folder.h"

#include <set>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

class CollectionFolder : public ProgramFolder {
protected:
    void put(const std::string& file, const std::string& content = "x") const {
        ProgramFolder::put(file, content);
    }
};

std::vector<std::string> names_of(const std::vector<BatchObject>& objects) {
    std::vector<std::string> names;
    for (const BatchObject& object : objects) {
        names.push_back(object.name);
    }
    return names;
}

TEST_F(CollectionFolder, ListsFoldersWithAnArtifactFileAndScans) {
    put("vase/artifact.toml");
    put("Bowl/artifact.toml");
    put("letters/notes.txt");
    put(".hidden/artifact.toml");
    put("packs/artifact.toml");
    put("cup.STL");
    put("cup.txt");
    put("report/artifact.toml");
    put("vase.glb");
    const Result<Collection> collection = list_collection(folder, folder / "packs");
    ASSERT_TRUE(collection) << collection.error().message;
    EXPECT_EQ(names_of(collection->objects),
              (std::vector<std::string>{"Bowl", "cup", "report", "vase", "vase"}));
    EXPECT_EQ(collection->skipped, std::vector<std::string>{"letters"});
    EXPECT_EQ(collection->objects[2].fault, "report: the batch's own reports have this name; rename it");
    EXPECT_EQ(collection->objects[3].fault, "");
    EXPECT_EQ(collection->objects[4].fault,
              "vase and vase.glb would have the same pack, vase.fspack; rename one of them");
    EXPECT_FALSE(list_collection(folder / "nowhere", folder));
}

TEST(Shards, KeepTheirObjectsWhenOthersAreRemoved) {
    std::vector<BatchObject> objects;
    for (int k = 0; k < 1000; ++k) {
        objects.push_back({std::to_string(k), {}, {}});
    }
    std::vector<std::string> before = names_of(share_of(objects, {3, 8}));
    EXPECT_NEAR(static_cast<double>(before.size()), 125.0, 40.0);
    const std::string first = before.front();
    std::erase_if(objects, [&](const BatchObject& object) { return object.name == first; });
    before.erase(before.begin());
    EXPECT_EQ(names_of(share_of(objects, {3, 8})), before);
}

TEST(Shards, ContainEachObjectOnce) {
    std::vector<BatchObject> objects;
    for (int k = 0; k < 23; ++k) {
        objects.push_back({std::to_string(k), {}, {}});
    }
    for (const std::size_t of : std::initializer_list<std::size_t>{1, 2, 7, 23, 40}) {
        std::multiset<std::string> all;
        for (std::size_t number = 1; number <= of; ++number) {
            for (const std::string& name : names_of(share_of(objects, {number, of}))) {
                all.insert(name);
            }
        }
        EXPECT_EQ(all.size(), objects.size()) << of;
        EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), objects.size()) << of;
    }
}

TEST(Shards, AreParsedAsNumberAndCount) {
    const Result<Shard> shard = parse_shard("3/8");
    ASSERT_TRUE(shard);
    EXPECT_EQ(shard->number, 3U);
    EXPECT_EQ(shard->of, 8U);
    for (const char* wrong :
         {"", "3", "/", "0/8", "9/8", "3/", "/8", "3/8/1", "-1/8", "3 /8", "1e1/20", "1/100001", "x/y"}) {
        const Result<Shard> refused = parse_shard(wrong);
        ASSERT_FALSE(refused) << wrong;
        EXPECT_EQ(refused.error().id, "batch.shard") << refused.error().message;
    }
}

TEST_F(CollectionFolder, HashesFilesLikeSha256sum) {
    put("scan.stl", std::string(3'000'000, 'a') + "end");
    ASSERT_EQ(std::system(fmt::format("cd '{}' && sha256sum scan.stl >sum.txt", folder.string()).c_str()), 0);
    const Result<std::string> hash = hash_of_object(folder / "scan.stl");
    ASSERT_TRUE(hash) << hash.error().message;
    EXPECT_EQ(*hash, text("sum.txt").substr(0, 64));
    EXPECT_FALSE(hash_of_file(folder / "nowhere"));
    EXPECT_FALSE(hash_of_file(folder)) << "a folder is no file";
}

TEST_F(CollectionFolder, HashesFoldersByNamesAndBytesOnly) {
    put("vase/artifact.toml", "one");
    put("vase/recordings/en/description.wav", "two");
    const std::string before = *hash_of_object(folder / "vase");
    put("vase/.artifact.toml.swp", "an editor's");
    fs::last_write_time(folder / "vase/artifact.toml",
                        fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(*hash_of_object(folder / "vase"), before) << "hidden files and times do not count";
    fs::rename(folder / "vase/recordings/en", folder / "vase/recordings/de");
    EXPECT_NE(*hash_of_object(folder / "vase"), before);
    fs::rename(folder / "vase/recordings/de", folder / "vase/recordings/en");
    EXPECT_EQ(*hash_of_object(folder / "vase"), before);
    put("vase/artifact.toml", "on");
    put("vase/recordings/en/description.wav", "etwo");
    EXPECT_NE(*hash_of_object(folder / "vase"), before) << "the same bytes, cut elsewhere";
}

} // namespace
} // namespace frustumscreen::programs
