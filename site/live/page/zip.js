// A zip of a few files, not compressed: enough to take them home in one download.

// Files by name; their contents as text or bytes.
export function zip(files) {
  const parts = [];
  const directory = [];
  let offset = 0;
  for (const [name, contents] of Object.entries(files)) {
    const path = new TextEncoder().encode(name);
    const data = typeof contents === "string" ? new TextEncoder().encode(contents) : contents;
    const head = fields(path, data);
    parts.push(bytes([[4, 0x04034b50], ...head]), path, data);
    directory.push(
      bytes([[4, 0x02014b50], [2, 20], ...head, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]), path,
    );
    offset += 30 + path.length + data.length;
  }
  const count = Object.keys(files).length;
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end = bytes([
    [4, 0x06054b50], [2, 0], [2, 0], [2, count], [2, count], [4, size], [4, offset], [2, 0],
  ]);
  return new Blob([...parts, ...directory, end], { type: "application/zip" });
}

// What both heads of a file have: version, names in UTF-8, no compression, the day, sizes.
function fields(path, data) {
  const now = new Date();
  const day = ((now.getFullYear() - 1980) << 9) | ((now.getMonth() + 1) << 5) | now.getDate();
  const time = (now.getHours() << 11) | (now.getMinutes() << 5) | (now.getSeconds() >> 1);
  return [
    [2, 20], [2, 0x0800], [2, 0], [2, time], [2, day], [4, crc32(data)], [4, data.length],
    [4, data.length], [2, path.length], [2, 0],
  ];
}

function bytes(numbers) {
  const view = new DataView(new ArrayBuffer(numbers.reduce((sum, [width]) => sum + width, 0)));
  let at = 0;
  for (const [width, number] of numbers) {
    if (width === 2) view.setUint16(at, number, true);
    else view.setUint32(at, number, true);
    at += width;
  }
  return new Uint8Array(view.buffer);
}

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let bit = 0; bit < 8; bit++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});

export function crc32(data) {
  let found = 0xffffffff;
  for (const byte of data) found = TABLE[(found ^ byte) & 0xff] ^ (found >>> 8);
  return (found ^ 0xffffffff) >>> 0;
}
