/// The devices of the live exhibit: tracker, camera, panel and sound, of any kind.
///
/// Threads  the render thread's; a device's own thread is hidden behind its interface. The camera's thread hands each
///          frame to its uses, in turn.
#pragma once

#include "app/drift/drift_watch.h"
#include "app/show/viewfinder.h"
#include "app/tags/tag_tracker.h"
#include "app/tracking/registered_tracker.h"
#include "app/visitor/visitor_tracker.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/panel/panel.h"
#include "firmware_host/sound/sound.h"
#include "firmware_host/tracker/packet_recorder.h"

#include <memory>

namespace frustumscreen::show {

struct Inputs {
    std::unique_ptr<tracker::PacketRecorder> recorder; ///< of the tracker's packets; outlives it
    Sentence why_not_recorded; ///< why the packets are not recorded; empty: they are, or recording is off
    std::unique_ptr<tracking::RegisteredTracker> tracker; ///< none: the prop stands at the table's centre
    std::unique_ptr<tags::TagTracker> tags;               ///< none: the prop has no second tracker
    std::unique_ptr<visitor::VisitorTracker> visitor;     ///< none: only sensors tell where a head is
    std::unique_ptr<drift::DriftWatch> drift;             ///< none: drift is not measured
    std::unique_ptr<Viewfinder> viewfinder; ///< none: no camera is used, or there are no buttons to hold
    std::unique_ptr<camera::Camera>
        camera; ///< source of their frames; declared after them, so that it ends first
    std::unique_ptr<panel::Panel> panel; ///< none: there are no buttons
    std::unique_ptr<sound::Sound> sound; ///< none: there is nothing to play
};

} // namespace frustumscreen::show
