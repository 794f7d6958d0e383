// A stick's folders, decoded from bytes: found files are in the root or one folder down, not in a recycle
// bin, and limited in number.
//
// An entry: kind (a file, a folder, other; above 0xF0 the listing fails there with that errno), length of the
// name, name. A folder's own entries follow those of the root, in the order in which it is listed; kind 0xEF
// ends a folder.
#include "app/library/stick_walk.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <cerrno>

using namespace frustumscreen;

namespace {

class DecodedTree final : public FileTree {
public:
    explicit DecodedTree(std::string_view bytes) : bytes_(bytes) {}

    FileResult<void> list(const std::string& /*folder*/,
                          const std::function<bool(const FolderEntry&)>& visit) override {
        while (bytes_.size() >= 2) {
            const auto kind = static_cast<std::uint8_t>(bytes_[0]);
            const std::size_t length =
                std::min<std::size_t>(static_cast<std::uint8_t>(bytes_[1]), bytes_.size() - 2);
            std::string name(bytes_.substr(2, length));
            bytes_.remove_prefix(2 + length);
            if (kind == 0xEF) {
                return {};
            }
            if (kind >= 0xF0) {
                return file_fault(kind == 0xF0 ? EACCES : kind - 0xF0);
            }
            std::erase(name, '/');
            std::erase(name, '\0');
            if (name.empty() || name == "." || name == "..") {
                continue;
            }
            if (!visit({std::move(name), static_cast<EntryKind>(kind % 3)})) {
                return {};
            }
        }
        return {};
    }
    FileResult<std::unique_ptr<const FileContent>> open(const std::string& /*path*/) override {
        return file_fault(EIO);
    }

private:
    std::string_view bytes_;
};

void require_pack(const std::string& path) {
    const std::size_t slash = path.find('/');
    fuzz::require(path.find('/', slash == std::string::npos ? 0 : slash + 1) == std::string::npos,
                  "packs lie one folder down at most", path);
    const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
    fuzz::require(!library::is_ignored(name) &&
                      (slash == std::string::npos || !library::is_ignored(path.substr(0, slash))),
                  "nothing of a bin is found", path);
    fuzz::require(name.size() >= 7 && (name[name.size() - 7] == '.'), "packs are called so", path);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    DecodedTree tree(fuzz::text_of(data, size));
    library::ImportLimits limits;
    limits.max_entries = 40;
    limits.max_folders = 8;
    limits.max_packs = 12;
    int asked = 0;
    const auto found = library::walk_stick(tree, limits, [&] { return ++asked > 60; });
    if (!found) {
        fuzz::require(found.error().whole, "a stick is refused as a whole");
        fuzz::require_one_line(found.error().reason);
        return 0;
    }
    fuzz::require(found->packs.size() + found->refused.size() <= limits.max_packs + limits.max_folders,
                  "it is not too much");
    fuzz::require(std::is_sorted(found->packs.begin(), found->packs.end()), "packs are in order");
    for (const std::string& path : found->packs) {
        require_pack(path);
    }
    for (const library::ImportedPack& line : found->refused) {
        fuzz::require_one_line(line.reason);
        fuzz::require_one_line(line.file);
    }
    return 0;
}
