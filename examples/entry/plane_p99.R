# SPDX-License-Identifier: Apache-2.0
# The entry of plane_p99.py in base R: Rscript plane_p99.R TASK SUBMISSION
# In each given box, the 99th percentile of the points' heights over a plane through the ground around it.

read_cloud <- function(path) {
  bytes <- readBin(path, "raw", file.size(path))
  header <- rawToChar(bytes[1:512])  # of this length in every cloud of an export
  points <- as.integer(sub(".*\nPOINTS ([0-9]+)\n.*", "\\1", header))
  record <- matrix(bytes[513:length(bytes)], ncol = points)  # 28 bytes a point, x, y and z in front
  column <- function(from) readBin(as.vector(record[from:(from + 3), ]), "numeric", points, size = 4, endian = "little")
  data.frame(x = column(1), y = column(5), z = column(9))
}

height <- function(cloud, box) {
  angle <- box$heading_deg * pi / 180
  east <- cloud$x - box$center_x_m
  north <- cloud$y - box$center_y_m
  along <- abs(east * cos(angle) + north * sin(angle)) - box$length_m / 2
  across <- abs(north * cos(angle) - east * sin(angle)) - box$width_m / 2
  outside <- pmax(along, across)  # metres, negative inside
  ring <- cloud[outside > 0.1 & outside < 0.6, ]
  ground <- ring[ring$z < quantile(ring$z, 0.3), ]  # the rest are leaves
  plot <- cloud[outside < 0, ]
  quantile(plot$z - predict(lm(z ~ x + y, ground), plot), 0.99, names = FALSE)
}

arguments <- commandArgs(trailingOnly = TRUE)
task <- arguments[1]
submission <- arguments[2]
dir.create(submission)
writeLines('{"method": "plane-p99-r"}', file.path(submission, "submission.json"))
file.copy(file.path(task, "task.json"), submission)
for (field in basename(list.dirs(task, recursive = FALSE))) {
  cloud <- read_cloud(file.path(task, field, "cloud.pcd"))
  boxes <- read.csv(file.path(task, field, "boxes.csv"))
  heights <- sapply(seq_len(nrow(boxes)), function(i) height(cloud, boxes[i, ]))
  write.csv(data.frame(plot_number = boxes$plot_number, height_p99_m = heights),
            file.path(submission, paste0(field, ".csv")), row.names = FALSE, quote = FALSE)
}
