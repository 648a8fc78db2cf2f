// SPDX-License-Identifier: Apache-2.0
#include "plots/find_plots.h"
