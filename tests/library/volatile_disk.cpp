#include "tests/library/volatile_disk.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>

namespace frustumscreen::testing_disk {

namespace {

const Content no_bytes = std::make_shared<const Bytes>();

class ReadContent final : public FileContent {
public:
    ReadContent(VolatileDisk& disk, Content content) : disk_(disk), content_(std::move(content)) {}
    [[nodiscard]] std::uint64_t bytes() const override { return content_->size(); }
    [[nodiscard]] int read(std::uint64_t offset, std::span<std::byte> out) const override {
        if (const VolatileDisk::Step step = disk_.step(); step.error != 0) {
            return step.error;
        }
        if (offset > content_->size() || out.size() > content_->size() - offset) {
            return ENODATA;
        }
        std::copy_n(content_->begin() + static_cast<std::ptrdiff_t>(offset), out.size(),
                    out.begin()); // also of none
        return 0;
    }

private:
    VolatileDisk& disk_;
    Content content_;
};

Content joined(const Content& content, const Bytes& more) {
    Bytes bytes = *content;
    bytes.insert(bytes.end(), more.begin(), more.end());
    return std::make_shared<const Bytes>(std::move(bytes));
}

/// The possible contents of a file that was not synced: none of it, all, its size alone, its beginning, its end
/// alone.
std::vector<Content> contents_after_cut(const File& file) {
    if (file.pending.empty()) {
        return {file.on_disk};
    }
    Bytes zeros = *file.now;
    const std::size_t kept = std::min(zeros.size(), file.on_disk->size());
    const bool was_emptied = std::any_of(file.pending.begin(), file.pending.end(),
                                         [](const Append& each) { return each.bytes == nullptr; });
    std::fill(zeros.begin() + static_cast<std::ptrdiff_t>(was_emptied ? 0 : kept), zeros.end(), std::byte{0});
    Bytes beginning = *file.now;
    beginning.resize(beginning.size() / 2);
    Bytes end = *file.now;
    std::fill(end.begin(), end.begin() + static_cast<std::ptrdiff_t>(end.size() / 2), std::byte{0});
    std::vector<Content> contents{file.on_disk, file.now};
    for (Bytes* other : {&zeros, &beginning, &end}) {
        const bool is_new = std::none_of(contents.begin(), contents.end(),
                                         [&](const Content& each) { return *each == *other; });
        if (is_new) {
            contents.push_back(std::make_shared<const Bytes>(std::move(*other)));
        }
    }
    return contents;
}

} // namespace

class VolatileFile final : public NewFile {
public:
    VolatileFile(VolatileDisk& disk, int node) : disk_(disk), node_(static_cast<std::size_t>(node)) {}
    FileResult<void> append(std::span<const std::byte> bytes) override {
        const VolatileDisk::Step step = disk_.step();
        if (step.done || step.error == ENOSPC) { // a full disk takes the first half
            Bytes more(bytes.begin(), bytes.end());
            more.resize(step.done ? more.size() : more.size() / 2);
            File& file = disk_.nodes_[node_].file;
            file.now = joined(file.now, more);
            file.pending.push_back({std::make_shared<const Bytes>(std::move(more))});
        }
        return step.error == 0 ? FileResult<void>() : file_fault(step.error);
    }
    FileResult<void> sync() override {
        const VolatileDisk::Step step = disk_.step();
        if (step.done) {
            File& file = disk_.nodes_[node_].file;
            file.on_disk = file.now;
            file.pending.clear();
        }
        return step.error == 0 ? FileResult<void>() : file_fault(step.error);
    }

private:
    VolatileDisk& disk_;
    std::size_t node_;
};

VolatileDisk::VolatileDisk() {
    nodes_.push_back({Folder{}, {}});
}

std::unique_ptr<VolatileDisk> VolatileDisk::copy() const {
    auto other = std::make_unique<VolatileDisk>();
    other->nodes_ = nodes_;
    other->free = free;
    return other;
}

VolatileDisk::Step VolatileDisk::step() {
    const int number = operations++;
    if (number >= plan.stop_before) {
        throw Stopped();
    }
    if (before_operation) {
        before_operation(number);
    }
    const bool fails = number >= plan.fail_from && number < plan.fail_to;
    return {fails ? plan.error : 0, !fails || plan.done_all_the_same};
}

std::optional<int> VolatileDisk::find(const std::string& path) const {
    int node = 0;
    for (std::size_t at = 0; at < path.size();) {
        const std::size_t slash = std::min(path.find('/', at), path.size());
        const std::optional<Folder>& folder = nodes_[static_cast<std::size_t>(node)].folder;
        const std::string name = path.substr(at, slash - at);
        if (!folder || !folder->now.contains(name)) {
            return std::nullopt;
        }
        node = folder->now.at(name);
        at = slash + 1;
    }
    return node;
}

std::optional<std::pair<int, std::string>> VolatileDisk::place_of(const std::string& path) const {
    const std::size_t slash = path.rfind('/');
    const bool inner = slash != std::string::npos;
    const std::optional<int> folder = find(inner ? path.substr(0, slash) : "");
    if (!folder || !nodes_[static_cast<std::size_t>(*folder)].folder) {
        return std::nullopt;
    }
    return std::pair(*folder, inner ? path.substr(slash + 1) : path);
}

FileResult<void> VolatileDisk::change(int folder, NameChange names, const Step& step) {
    if (step.done) {
        Folder& changed = *nodes_[static_cast<std::size_t>(folder)].folder;
        for (const auto& [name, node] : names) {
            changed.now.erase(name);
            if (node) {
                changed.now[name] = *node;
            }
        }
        changed.pending.push_back(std::move(names));
    }
    return step.error == 0 ? FileResult<void>() : file_fault(step.error);
}

FileResult<void> VolatileDisk::list(const std::string& folder,
                                    const std::function<bool(const FolderEntry&)>& visit) {
    const Step began = step();
    const std::optional<int> node = find(folder);
    if (began.error != 0 || !node || !nodes_[static_cast<std::size_t>(*node)].folder) {
        return file_fault(began.error != 0 ? began.error : ENOENT);
    }
    const std::map<std::string, int> names = nodes_[static_cast<std::size_t>(*node)].folder->now;
    for (const auto& [name, entry] : names) {
        const bool is_folder = nodes_[static_cast<std::size_t>(entry)].folder.has_value();
        if (!visit({name, is_folder ? EntryKind::Folder : EntryKind::File})) {
            return {};
        }
    }
    return {};
}

FileResult<std::unique_ptr<const FileContent>> VolatileDisk::open(const std::string& path) {
    const Step began = step();
    const std::optional<int> node = find(path);
    if (began.error != 0 || !node) {
        return file_fault(began.error != 0 ? began.error : ENOENT);
    }
    const Node& found = nodes_[static_cast<std::size_t>(*node)];
    if (found.folder) {
        return file_fault(EINVAL);
    }
    return std::make_unique<ReadContent>(*this, found.file.now);
}

FileResult<std::unique_ptr<NewFile>> VolatileDisk::create(const std::string& path) {
    const Step began = step();
    const auto place = place_of(path);
    if (!place) {
        return file_fault(ENOENT);
    }
    std::optional<int> node = find(path);
    if (began.done && node) {
        File& file = nodes_[static_cast<std::size_t>(*node)].file;
        file.now = no_bytes;
        file.pending.push_back({nullptr});
    } else if (began.done) {
        node = static_cast<int>(nodes_.size());
        nodes_.push_back({std::nullopt, {no_bytes, no_bytes, {}}});
        static_cast<void>(change(place->first, {{place->second, node}}, {}));
    }
    if (began.error != 0) {
        return file_fault(began.error);
    }
    return std::make_unique<VolatileFile>(*this, *node);
}

FileResult<void> VolatileDisk::rename(const std::string& from, const std::string& to) {
    const Step began = step();
    const std::optional<int> node = find(from);
    const auto old_place = place_of(from);
    const auto new_place = place_of(to);
    if (!node || !new_place || old_place->first != new_place->first) {
        return file_fault(node ? EXDEV : ENOENT); // the library never renames between folders
    }
    return change(old_place->first, {{old_place->second, std::nullopt}, {new_place->second, node}}, began);
}

FileResult<void> VolatileDisk::remove(const std::string& path) {
    const Step began = step();
    const auto place = place_of(path);
    if (!place || !find(path)) {
        return file_fault(ENOENT);
    }
    return change(place->first, {{place->second, std::nullopt}}, began);
}

FileResult<void> VolatileDisk::make_folder(const std::string& path) {
    const Step began = step();
    const auto place = place_of(path);
    if (!place) {
        return file_fault(ENOENT);
    }
    if (find(path)) {
        return began.error == 0 ? FileResult<void>() : file_fault(began.error);
    }
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back({Folder{}, {}});
    return change(place->first, {{place->second, node}}, began);
}

FileResult<void> VolatileDisk::sync_folder(const std::string& path) {
    const Step began = step();
    const std::optional<int> node = find(path);
    if (!node) {
        return file_fault(ENOENT);
    }
    if (began.done) {
        Folder& folder = *nodes_[static_cast<std::size_t>(*node)].folder;
        folder.on_disk = folder.now;
        folder.pending.clear();
    }
    return began.error == 0 ? FileResult<void>() : file_fault(began.error);
}

FileResult<std::uint64_t> VolatileDisk::free_bytes() {
    const Step began = step();
    if (began.error != 0) {
        return file_fault(began.error);
    }
    return free;
}

void VolatileDisk::undisturbed(const std::function<void()>& change) {
    const FaultPlan planned = std::exchange(plan, {});
    const auto meanwhile = std::exchange(before_operation, {});
    const int counted = operations;
    change();
    sync_all();
    plan = planned;
    before_operation = meanwhile;
    operations = counted;
}

void VolatileDisk::take_away(const std::string& path) {
    undisturbed([&] { static_cast<void>(remove(path)); });
}

void VolatileDisk::put(const std::string& path, const Bytes& bytes) {
    undisturbed([&] {
        if (const std::size_t slash = path.rfind('/'); slash != std::string::npos) {
            static_cast<void>(make_folder(path.substr(0, slash)));
        }
        static_cast<void>(create(path).value()->append(bytes));
    });
}

void VolatileDisk::put(const std::string& path, std::string_view text) {
    const auto bytes = as_bytes(text);
    put(path, Bytes(bytes.begin(), bytes.end()));
}

std::optional<Content> VolatileDisk::content(const std::string& path) const {
    const std::optional<int> node = find(path);
    if (!node || nodes_[static_cast<std::size_t>(*node)].folder) {
        return std::nullopt;
    }
    return nodes_[static_cast<std::size_t>(*node)].file.now;
}

void VolatileDisk::sync_all() {
    for (Node& node : nodes_) {
        node.file.on_disk = node.file.now;
        node.file.pending.clear();
        if (node.folder) {
            node.folder->on_disk = node.folder->now;
            node.folder->pending.clear();
        }
    }
}

int VolatileDisk::cut_power(int most, unsigned seed, const std::function<void(VolatileDisk&)>& visit) const {
    // One digit for each choice: a change of names is there or not; which of its contents a file has.
    std::vector<std::vector<Content>> contents;
    std::vector<unsigned> choices;
    for (const Node& node : nodes_) {
        contents.push_back(node.folder ? std::vector<Content>{} : contents_after_cut(node.file));
        if (node.folder) {
            choices.insert(choices.end(), node.folder->pending.size(), 2U);
        } else {
            choices.push_back(static_cast<unsigned>(contents.back().size()));
        }
    }
    double all = 1.0;
    for (const unsigned each : choices) {
        all *= each;
    }
    const bool every_one = all <= most;
    const int count = every_one ? static_cast<int>(all) : most;
    std::mt19937 random(seed);
    for (int k = 0; k < count; ++k) {
        auto disk = std::make_unique<VolatileDisk>();
        disk->nodes_ = nodes_;
        disk->free = free;
        std::size_t digit = 0;
        auto left = static_cast<unsigned>(k);
        const auto choose = [&] {
            const unsigned from = choices[digit++];
            const unsigned chosen = every_one ? left % from
                                    : k < 2   ? static_cast<unsigned>(k) % from
                                              : static_cast<unsigned>(random()) % from;
            left /= from;
            return chosen;
        };
        for (std::size_t n = 0; n < disk->nodes_.size(); ++n) {
            Node& node = disk->nodes_[n];
            if (!node.folder) {
                node.file = {contents[n][choose()], nullptr, {}};
                node.file.on_disk = node.file.now;
                continue;
            }
            std::map<std::string, int> names = node.folder->on_disk;
            for (const NameChange& change : node.folder->pending) {
                if (choose() == 1U) {
                    for (const auto& [name, number] : change) {
                        names.erase(name);
                        if (number) {
                            names[name] = *number;
                        }
                    }
                }
            }
            node.folder = Folder{names, names, {}};
        }
        visit(*disk);
    }
    return count;
}

} // namespace frustumscreen::testing_disk
