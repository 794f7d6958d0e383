#include "tests/display/fake_kernel.h"

#include <fcntl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

extern "C" int __real_close(int file);

namespace frustumscreen::display {

namespace {

FakeKernel* current = nullptr;

struct Errors {
    std::string_view call;
    std::vector<int> errors;
};

} // namespace

FakeKernel::FakeKernel() {
    before_ = std::exchange(current, this);
}

FakeKernel::~FakeKernel() {
    current = before_;
}

FakeKernel& FakeKernel::instance() {
    return *current;
}

bool FakeKernel::is_there() {
    return current != nullptr;
}

FakeCard& FakeKernel::add_card(const std::string& path) {
    cards_[path] = std::make_unique<FakeCard>();
    return *cards_[path];
}

std::vector<int> FakeKernel::errors_of(std::string_view call) {
    static const std::vector<Errors> known{
        {"open", {EACCES, EINTR, EMFILE, ENODEV, ENOENT}},
        {"mmap", {ENOMEM}},
        {"drmSetMaster", {EACCES, EBUSY, EINVAL}},
        {"drmSetClientCap", {EINVAL, EOPNOTSUPP}},
        {"drmModeAtomicAlloc", {ENOMEM}},
        {"drmModeAtomicAddProperty", {ENOMEM}},
        {"drmModeAtomicCommit", {EINVAL, EACCES, EBUSY, ENODEV, ENOENT, ENOMEM, ENOSPC, ERANGE}},
        {"drmModeSetCrtc", {EINVAL, EACCES, EBUSY, ENODEV, ENOENT, ENOMEM, ENOSPC}},
        {"drmModePageFlip", {EINVAL, EACCES, EBUSY, ENODEV, ENOENT, ENOMEM, ENOSPC}},
        {"drmModeObjectSetProperty", {EINVAL, EACCES, ENODEV, ENOENT}},
        {"drmModeAddFB", {EINVAL, ENODEV, ENOENT, ENOMEM}},
        {"drmModeAddFB2", {EINVAL, ENODEV, ENOENT, ENOMEM}},
        {"drmModeCreateDumbBuffer", {EINVAL, ENODEV, ENOMEM, ENOSPC, ENOSYS}},
        {"drmModeGetProperty", {ENOMEM}},
        {"drmModeCreateLease", {EINVAL, EACCES, EBUSY, ENODEV, ENOENT, ENOMEM, EOPNOTSUPP}},
        {"drmCrtcGetSequence", {EINVAL, ENODEV, EOPNOTSUPP}},
        {"drmGetCap", {EINVAL, ENODEV}},
    };
    const auto found =
        std::find_if(known.begin(), known.end(), [call](const Errors& one) { return one.call == call; });
    return found != known.end() ? found->errors : std::vector<int>{ENODEV, ENOMEM};
}

int FakeKernel::enter(std::string_view call) {
    calls_.emplace_back(call);
    if (calls_.size() == failing_.first) {
        return failing_.second;
    }
    const auto refused = refused_.find(call);
    return refused != refused_.end() ? refused->second : 0;
}

FakeFile* FakeKernel::file(int number) {
    const auto found = files_.find(number);
    return found != files_.end() ? &found->second : nullptr;
}

FakeCard* FakeKernel::card_at(std::string_view path) {
    const auto found = cards_.find(path);
    return found != cards_.end() ? found->second.get() : nullptr;
}

const FakeGpu* FakeKernel::gpu_at(std::string_view path) const {
    const auto found =
        std::find_if(gpus_.begin(), gpus_.end(), [path](const FakeGpu& gpu) { return gpu.path == path; });
    return found != gpus_.end() ? &*found : nullptr;
}

int FakeKernel::open_file(FakeCard* card, const FakeGpu* gpu, int flags) {
    std::array<int, 2> ends{};
    const bool blocks = (flags & O_NONBLOCK) == 0;
    const int type = SOCK_SEQPACKET | SOCK_CLOEXEC | (blocks ? 0 : SOCK_NONBLOCK); // keeps events whole
    if (::socketpair(AF_UNIX, type, 0, ends.data()) != 0) {
        return -1;
    }
    FakeFile& opened = files_[ends[0]];
    opened.card = card;
    opened.events = ends[1];
    if (card != nullptr) {
        card->opened(opened);
    }
    opened.renderer = gpu != nullptr ? gpu->renderer : "";
    return ends[0];
}

int FakeKernel::lease(FakeFile& lessor, std::span<const std::uint32_t> objects) {
    std::set<std::uint32_t> held;
    for (const auto& [number, file] : files_) {
        if (file.lessor == &lessor) {
            held.insert(file.leased.begin(), file.leased.end());
        }
    }
    if (const int refused = lessor.card->judge_lease(lessor, objects, held); refused != 0) {
        return refused;
    }
    const int number = open_file(lessor.card, nullptr, O_NONBLOCK);
    FakeFile& lessee = files_.at(number);
    lessee.lessor = &lessor;
    lessee.leased = lessor.card->leased_with(lessor, objects);
    return number;
}

void FakeKernel::close_file(int number) {
    const auto found = files_.find(number);
    if (found == files_.end()) {
        return;
    }
    for (auto& [other, file] : files_) { // drm_lease_revoke
        if (file.lessor == &found->second) {
            file.lessor = nullptr;
            file.leased.clear();
            wrongs_ += "closed before its lease; ";
        }
    }
    if (found->second.card != nullptr) {
        if (const std::string left = found->second.card->closed(found->second); !left.empty()) {
            wrongs_ += "closed with " + left + "; ";
        }
    }
    __real_close(found->second.events);
    files_.erase(found);
}

void FakeKernel::hand_out(const void* what, std::string kind, std::shared_ptr<void> memory) {
    handed_out_[what] = {std::move(kind), std::move(memory)};
}

void FakeKernel::give_back(const void* what, std::string_view kind) {
    const auto found = handed_out_.find(what);
    if (found == handed_out_.end() || found->second.kind != kind) {
        wrongs_ += std::string(kind) + " given back without being handed out; ";
        return;
    }
    handed_out_.erase(found);
}

std::string FakeKernel::alive() const {
    std::map<std::string, int> numbers;
    for (const auto& [what, one] : handed_out_) {
        ++numbers[one.kind];
    }
    for (const auto& [number, file] : files_) {
        ++numbers["file"];
        numbers["framebuffer"] += static_cast<int>(file.framebuffers.size());
        numbers["blob"] += static_cast<int>(file.blobs.size());
        numbers["buffer"] += static_cast<int>(file.handles.size());
    }
    std::string words;
    for (const auto& [kind, number] : numbers) {
        words += number > 0 ? std::to_string(number) + " " + kind + "; " : "";
    }
    return words;
}

} // namespace frustumscreen::display
