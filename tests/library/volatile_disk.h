/// A disk that exists only in memory and forgets, at a power cut, what was not synced: the files of a POSIX system as they are
/// promised, not as one file system happens to keep them.
///
/// Model    A file's bytes are on the disk after sync(). Before, any of its appends may be there, be zeros, or be missing. A name
///          that was made, renamed or removed is on the disk after sync_folder() of its folder. Before, any of these operations
///          may be there without the others; one rename is there as a whole or not at all.
/// Faults   each operation, reading too, has a number, from 0 on; a plan lets some of them fail, or stops the process at one.
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

/// The process is gone: nothing is done any more.
struct Stopped : std::runtime_error {
    Stopped() : std::runtime_error("stopped") {}
};

struct FaultPlan {
    static constexpr int never = std::numeric_limits<int>::max();
    int stop_before = never;        ///< this operation and all after it are not done
    int fail_from = never;          ///< these fail ...
    int fail_to = never;            ///< ... up to this one, not included
    int error = 0;                  ///< with this errno
    bool done_all_the_same = false; ///< what fails has been done nevertheless
};

using Content = std::shared_ptr<const Bytes>;

struct Append {
    Content bytes; ///< null: the file was emptied
};
struct File {
    Content now, on_disk;
    std::vector<Append> pending;
};
/// Names that one operation sets at once; no number: the name is removed.
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
    /// Everything that there is now, with no faults planned.
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

    /// For a test: a file with these bytes, on the disk; its folder is made.
    void put(const std::string& path, const Bytes& bytes);
    void put(const std::string& path, std::string_view text);
    void take_away(const std::string& path);
    [[nodiscard]] std::optional<Content> content(const std::string& path) const;
    /// All is on the disk.
    void sync_all();

    /// What may be left after a power cut now, each as a new disk: all that there can be, if these are at most `most`; else the two
    /// extremes and others by `seed`. Returns how many.
    int cut_power(int most, unsigned seed, const std::function<void(VolatileDisk&)>& visit) const;

    FaultPlan plan;
    std::function<void(int operation)> before_operation; ///< for what changes meanwhile
    std::uint64_t free = std::uint64_t{1} << 40U;
    int operations = 0; ///< so far
    /// Counts; 0, or the errno with which it fails. `done`: whether its effect is to happen.
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
