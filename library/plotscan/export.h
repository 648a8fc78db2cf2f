// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the shared libraries show; all else in them is hidden.
#define PLOTSCAN_API __attribute__((visibility("default")))
