// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Play/RunPlay.h"
#include "Report/Picture.h"

namespace myotet::app {

/// The box that pictures of a scene show: bodies and balls where they begin, and the
/// obstacles beneath and beside them.
[[nodiscard]] Box box_of_play(const play::PlayScene& scene, const play::World& world);

/// A frame as the scene's view has it, from a little above: each body in a colour of its own,
/// balls dark, obstacles grey. What stands between the viewer and a bin's content is left out.
[[nodiscard]] report::Picture play_picture(const play::PlayScene& scene,
                                           const play::PlayFrame& frame, const Box& fit);

}  // namespace myotet::app
