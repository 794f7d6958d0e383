#include "app/scene/device_plan.h"

#include "app/settings/command.h"
#include "app/settings/guided.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace frustumscreen::scene {

namespace {

/// The tasks of the camera's reader, for its name in the list of threads.
std::string camera_uses(const DevicePlan& plan) {
    std::vector<std::string_view> uses;
    if (plan.tags) {
        uses.emplace_back(plan.torch == settings::TorchSource::Camera ||
                                  plan.torch == settings::TorchSource::Both
                              ? "finds the tags of the prop and the torch"
                              : "finds the prop's tags");
    }
    if (plan.visitor) {
        uses.emplace_back("sees who stands at the table");
    }
    if (plan.drift) {
        uses.emplace_back("finds the marks");
    }
    return fmt::format("{}", fmt::join(uses, " and "));
}

} // namespace

DevicePlan plan_devices(const settings::Settings& settings, bool pressed, bool status_file) {
    const std::vector<settings::ScriptedPress>& script = settings.panel.script;
    const bool real = settings.panel.kind != settings::PanelKind::Scripted;
    const auto asks = [&](settings::Command command) {
        const int button = settings::button_of(command);
        if (real) {
            return static_cast<std::size_t>(button) < settings.panel.buttons();
        }
        return std::any_of(script.begin(), script.end(),
                           [button](const settings::ScriptedPress& press) { return press.button == button; });
    };
    DevicePlan plan;
    plan.tracker = settings.tracker.kind;
    plan.torch = settings.torch.source;
    plan.screen = settings.screen.exists();
    plan.head = settings.eye.tracked && plan.tracker != settings::TrackerKind::None;
    plan.tags = settings.camera.tags;
    plan.visitor = settings.camera.visitor;
    plan.drift = settings.camera.drift && settings.calibration.used;
    plan.panel = pressed || real || !script.empty();
    plan.other_packs = pressed || asks(settings::Command::PreviousArtifact) ||
                       asks(settings::Command::NextArtifact) || settings::chooses_on_table(settings);
    plan.language = !pressed && asks(settings::Command::NextLanguage);
    plan.threads = {"the exhibit"};
    if (plan.tracker == settings::TrackerKind::Usb || plan.tracker == settings::TrackerKind::SpaceMouse) {
        plan.threads.emplace_back("the tracker's reader");
    }
    if (const std::string uses = camera_uses(plan); !uses.empty()) {
        plan.threads.push_back("the camera's reader, which " + uses);
    }
    if (real && !pressed) {
        plan.threads.emplace_back("the buttons' watcher");
    }
    if (settings::tells_of_sticks(settings)) {
        plan.threads.emplace_back("the reader of what the importer says");
    }
    if (status_file) {
        plan.threads.emplace_back("the status file's writer");
    }
    if (plan.tracker == settings::TrackerKind::None) {
        plan.left_out.emplace_back(plan.tags
                                       ? "No tracker is opened: the prop is followed by its tags alone."
                                       : "No tracker is opened: the prop stands at the table's centre.");
    }
    if (!settings.eye.tracked) {
        plan.left_out.emplace_back("No head is followed: the viewer is fixed.");
    }
    if (!plan.screen) {
        plan.left_out.emplace_back("No screen is opened and no room is read: the settings have no screen.");
    }
    if (!settings.torch.exists()) {
        plan.left_out.emplace_back(
            "No torch is followed and none of its contents is read: the settings have no torch.");
    }
    if (!plan.panel) {
        plan.left_out.emplace_back("No button panel is opened: no button is configured.");
    }
    if (!plan.other_packs && settings.exhibit.packs.size() > 1) {
        plan.left_out.emplace_back(
            "Only the first pack is loaded: no button and no picture on the table leads to another.");
    }
    if (!status_file) {
        plan.left_out.emplace_back("No thread writes a status: no status file is asked for.");
    }
    return plan;
}

} // namespace frustumscreen::scene
