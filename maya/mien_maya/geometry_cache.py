# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Maya's geometry cache, one file a mesh: an XML that describes it and an IFF of big-endian blocks (.mcc)."""
import array
import struct
import sys
import typing
import xml.sax.saxutils

TICKS = 6000  # of a second

XML = """<?xml version="1.0"?>
<Autodesk_Cache_File>
  <cacheType Type="OneFile" Format="mcc"/>
  <time Range="{first}-{last}"/>
  <cacheTimePerFrame TimePerFrame="{frame}"/>
  <cacheVersion Version="2.0"/>
  <Channels>
    <channel0 ChannelName={name} ChannelType="FloatVectorArray" ChannelInterpretation="positions" \
SamplingType="Irregular" SamplingRate="{frame}" StartTime="{first}" EndTime="{last}"/>
  </Channels>
</Autodesk_Cache_File>
"""


def _block(tag: bytes, data: bytes) -> bytes:
    return tag + struct.pack(">i", len(data)) + data + b"\0" * (-len(data) % 4)


def _group(kind: bytes, blocks: typing.Sequence[bytes]) -> bytes:
    return _block(b"FOR4", kind + b"".join(blocks))


class GeometryCacheWriter:
    """Writes PATH.xml and PATH.mcc; rows are array("f") of x, y, z in the mesh's own space."""

    def __init__(self, path: str, channel: str, seconds: typing.Sequence[float], frames_per_second: float):
        self._channel = channel
        self._times = [round(TICKS * second) for second in seconds]
        self._row = 0
        first, last = self._times[0], self._times[-1]
        with open(path + ".xml", "w", encoding="utf-8") as file:
            file.write(XML.format(first=first, last=last, frame=round(TICKS / frames_per_second),
                                  name=xml.sax.saxutils.quoteattr(channel)))
        self._file = open(path + ".mcc", "wb")
        self._file.write(_group(b"CACH", [_block(b"VRSN", b"0.1\0"), _block(b"STIM", struct.pack(">i", first)),
                                          _block(b"ETIM", struct.pack(">i", last))]))

    def row(self, values: array.array) -> None:
        swapped = array.array("f", values)
        if sys.byteorder == "little":
            swapped.byteswap()
        self._file.write(_group(b"MYCH", [
            _block(b"TIME", struct.pack(">i", self._times[self._row])), _block(b"CHNM", self._channel.encode() + b"\0"),
            _block(b"SIZE", struct.pack(">i", len(values) // 3)), _block(b"FVCA", swapped.tobytes())]))
        self._row += 1

    def __enter__(self) -> "GeometryCacheWriter":
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()
