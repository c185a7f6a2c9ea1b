# SPDX-License-Identifier: Apache-2.0
"""Reads 8-bit PNG files written by halfspace or ImageMagick as rows of (r, g, b) bytes."""
import struct
import zlib


def _unfilter(kind, line, above, step):
    """Undoes the filter of a row in place (PNG specification, section 9)."""
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        up = above[i]
        if kind == 1:
            predicted = left
        elif kind == 2:
            predicted = up
        elif kind == 3:
            predicted = (left + up) // 2
        else:
            corner = above[i - step] if i >= step else 0
            p = left + up - corner
            distances = (abs(p - left), abs(p - up), abs(p - corner))
            predicted = (left, up, corner)[distances.index(min(distances))]
        line[i] = (line[i] + predicted) & 255


def read_rows(path):
    """Returns (width, height, rows); each row has three bytes per pixel. Alpha is dropped and gray repeated."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is not a PNG file"
    at, packed, palette = 8, b"", b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        at += 12 + length
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", body[:10])
        elif kind == b"PLTE":
            palette = body
        elif kind == b"IDAT":
            packed += body
    assert bits == 8, f"{path} has {bits} bits per channel; expected 8"
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[color]
    raw, stride, rows = zlib.decompress(packed), width * channels, []
    above = bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        line = bytearray(raw[start + 1:start + 1 + stride])
        if raw[start]:
            _unfilter(raw[start], line, above, channels)
        above = line
        if color == 3:
            rows.append(b"".join(palette[3 * i:3 * i + 3] for i in line))
        elif channels <= 2:
            rows.append(bytes(v for v in line[::channels] for _ in range(3)))
        else:
            rows.append(bytes(line) if channels == 3 else bytes(v for i, v in enumerate(line) if i % 4 != 3))
    return width, height, rows
