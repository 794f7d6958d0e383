/// A disk that exists only in memory and loses, at a power cut, what was not synced. It gives the guarantees of
/// POSIX, not those of one particular file system.
///
/// Model    A file's bytes are on the disk after sync(). Before, any of its appends may be there, be zeros, or be
///          missing. A name that was made, renamed or removed is on the disk after sync_folder() of its folder.
///          Before, any of these operations may be there without the others; one rename is there as a whole or not
///          at all.
/// Faults   each operation, including reads, has a number, from 0 on; a plan makes some of them fail, or stops the
///          process at one.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/file_tree.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace frustumscreen::testing_disk {

/// The process was stopped: no further operation takes effect.
struct Stopped : std::runtime_error {
    Stopped() : std::runtime_error("stopped") {}
};

struct FaultPlan {
    static constexpr int never = std::numeric_limits<int>::max();
    int stop_before = never;        ///< this operation and all later ones do not take effect
    int fail_from = never;          ///< these operations fail ...
    int fail_to = never;            ///< ... up to this one, exclusive
    int error = 0;                  ///< with this errno
    bool done_all_the_same = false; ///< a failed operation has taken effect nevertheless
};

using Content = std::shared_ptr<const Bytes>;

struct Append {
    Content bytes; ///< null: the file was truncated to nothing
};
struct File {
    Content now, on_disk;
    std::vector<Append> pending;
};
/// Names that one operation sets at once; without a number, the name is removed.
using NameChange = std::vector<std::pair<std::string, std::optional<int>>>;
struct Folder {
    std::map<std::string, int> now, on_disk; ///< numbers of nodes
    std::vector<NameChange> pending;
};
struct Node {
    std::optional<Folder> folder; ///< else a file
    File file;
};

class VolatileDisk final : public WritableTree {
public:
    VolatileDisk();
    /// A copy of the present state, with no faults planned.
    [[nodiscard]] std::unique_ptr<VolatileDisk> copy() const;

    FileResult<void> list(const std::string& folder,
                          const std::function<bool(const FolderEntry&)>& visit) override;
    FileResult<std::unique_ptr<const FileContent>> open(const std::string& path) override;
    FileResult<std::unique_ptr<NewFile>> create(const std::string& path) override;
    FileResult<void> rename(const std::string& from, const std::string& to) override;
    FileResult<void> remove(const std::string& path) override;
    FileResult<void> make_folder(const std::string& path) override;
    FileResult<void> sync_folder(const std::string& path) override;
    FileResult<std::uint64_t> free_bytes() override;

    /// For a test: puts a file with these bytes on the disk, and makes its folder.
    void put(const std::string& path, const Bytes& bytes);
    void put(const std::string& path, std::string_view text);
    void take_away(const std::string& path);
    [[nodiscard]] std::optional<Content> content(const std::string& path) const;
    /// Syncs everything.
    void sync_all();

    /// The states that a power cut at this moment may leave, each as a new disk: all of them if they are at most
    /// `most`; else the two extremes and others by `seed`. Returns their number.
    int cut_power(int most, unsigned seed, const std::function<void(VolatileDisk&)>& visit) const;

    FaultPlan plan;
    std::function<void(int operation)> before_operation; ///< for changes during an import
    std::uint64_t free = std::uint64_t{1} << 40U;
    int operations = 0; ///< so far
    /// Counts the operation. `error`: 0, or the errno with which it fails. `done`: it takes effect.
    struct Step {
        int error = 0;
        bool done = true;
    };
    [[nodiscard]] Step step();

private:
    friend class VolatileFile;
    void undisturbed(const std::function<void()>& change);
    [[nodiscard]] std::optional<int> find(const std::string& path) const;
    [[nodiscard]] std::optional<std::pair<int, std::string>> place_of(const std::string& path) const;
    FileResult<void> change(int folder, NameChange names, const Step& step);
    std::vector<Node> nodes_; ///< 0: the root
};

} // namespace frustumscreen::testing_disk
