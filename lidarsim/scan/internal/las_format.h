// SPDX-License-Identifier: Apache-2.0
#pragma once

// What reader and writer share of LAS ("LAS Specification 1.4 - R15", ASPRS, 2019).

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace plotscan::scan::las {

inline constexpr int kNewFormats = 6;  // point formats from this one on are those of LAS 1.4
// Bytes of the point formats 0 to 10 without extra bytes (tables 7 to 18).
inline constexpr std::array<std::size_t, 11> kFormatSizes = {20, 28, 26, 34, 57, 63,
                                                             30, 36, 38, 59, 67};
inline constexpr std::size_t kHeaderSize = 375;  // of version 1.4
inline constexpr std::size_t kVlrHeaderSize = 54;
inline constexpr std::size_t kEvlrHeaderSize = 60;
inline constexpr std::size_t kExtraByteSize = 192;  // of a field's description

// User and record ids of variable length records.
inline constexpr std::string_view kSpecUser = "LASF_Spec";
inline constexpr std::uint16_t kExtraBytesRecord = 4;
inline constexpr std::string_view kProjectionUser = "LASF_Projection";
inline constexpr std::uint16_t kWktRecord = 2112;
inline constexpr std::uint16_t kGeoKeysRecord = 34735;
// Keys of GeoTIFF 1.1 (OGC 19-008r4, clause 7: GTModelTypeGeoKey, ProjectedCRSGeoKey, Units
// GeoKeys; numbers as in libgeotiff's geokeys_v1_1.inc): the kind of coordinate system, and a
// projected one's EPSG code and units.
inline constexpr std::uint16_t kModelKey = 1024;
inline constexpr std::uint16_t kGeographicModel = 2;  // degrees
inline constexpr std::uint16_t kGeocentricModel = 3;
inline constexpr std::uint16_t kProjectedKey = 3072;
// Units of x and y of a projected system, and of z: EPSG codes.
inline constexpr std::uint16_t kLinearUnitsKey = 3076;
inline constexpr std::uint16_t kVerticalKey = 4096;  // the system of heights: its EPSG code
inline constexpr std::uint16_t kVerticalUnitsKey = 4099;
inline constexpr std::uint16_t kUserDefined = 32767;  // no code
// Plotscan's own record: the UTC time of the points' time 0, as text.
inline constexpr std::string_view kPlotscanUser = "plotscan";
inline constexpr std::uint16_t kStartRecord = 1;

// Names of fields in a layout.
inline constexpr std::string_view kClassification = "classification";
inline constexpr std::string_view kWithheld = "withheld";
// Classes of points to leave out.
inline constexpr int kLowNoise = 7;
inline constexpr int kHighNoise = 18;

// Global encoding (table 4).
inline constexpr std::uint16_t kAdjustedGpsTime = 1;
inline constexpr std::uint16_t kWkt = 16;
// Adjusted standard GPS time is GPS time minus this.
inline constexpr double kGpsTimeAdjustment_s = 1e9;

// Scales intensities of 0..255 to the 16 bits of the format.
inline constexpr double kIntensityScale = 257;

}  // namespace plotscan::scan::las
