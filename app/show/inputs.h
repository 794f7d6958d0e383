/// What the live exhibit listens to and speaks through: a tracker, a camera, a panel, a sound, whichever they are.
///
/// Threads  the render thread's; a device's own thread is behind its interface. The camera's hands each frame to its uses, in turn.
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

namespace frustumscreen {

struct Inputs {
    std::unique_ptr<PacketRecorder> recorder; ///< of the tracker's packets; outlives it
    Sentence why_not_recorded; ///< why the packets are not recorded; empty: they are, or nobody asked for it
    std::unique_ptr<RegisteredTracker> tracker; ///< none: the prop stands at the table's centre
    std::unique_ptr<TagTracker> tags;           ///< none: the prop has no second tracker
    std::unique_ptr<VisitorTracker> visitor;    ///< none: nobody is seen who wears no sensor
    std::unique_ptr<DriftWatch> drift;          ///< none: nothing looks whether the picture moved
    std::unique_ptr<Viewfinder> viewfinder;     ///< none: no camera is used, or nobody could hold buttons
    std::unique_ptr<Camera> camera; ///< whose frames they use; it ends before them, so it stands after them
    std::unique_ptr<Panel> panel;   ///< none: nothing is pressed
    std::unique_ptr<Sound> sound;   ///< none: there is nothing to say
};

} // namespace frustumscreen
