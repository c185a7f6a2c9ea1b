# SPDX-License-Identifier: Apache-2.0
"""Reads 8-bit PNG files written by halfspace or ImageMagick as rows of (r, g, b) bytes."""
import struct
import zlib


def _unfilter(kind, line, above, step):
    """Undoes the filter of a row in place (PNG specification, section 9). Each filter has its own loop, because these loops take most of
    the time of reading a file."""
    if kind == 2:
        line[:] = bytes([(value + up) & 255 for value, up in zip(line, above)])
        return
    line[:0] = above[:0] = bytes(step)  # zeros to the left of the row
    if kind == 1:
        for i in range(step, len(line)):
            line[i] = (line[i] + line[i - step]) & 255
    elif kind == 3:
        for i in range(step, len(line)):
            line[i] = (line[i] + (line[i - step] + above[i]) // 2) & 255
    else:
        for i in range(step, len(line)):
            left, up, corner = line[i - step], above[i], above[i - step]
            to_left, to_up = abs(up - corner), abs(left - corner)
            to_corner = abs(left + up - 2 * corner)
            predicted = left if to_left <= to_up and to_left <= to_corner else up if to_up <= to_corner else corner
            line[i] = (line[i] + predicted) & 255
    del line[:step], above[:step]


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
