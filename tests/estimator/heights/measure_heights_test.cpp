// SPDX-License-Identifier: Apache-2.0
#include "heights/measure_heights.h"

#include <gtest/gtest.h>
