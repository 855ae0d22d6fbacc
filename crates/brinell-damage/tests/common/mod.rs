//! Files made for the tests.
#![allow(dead_code, unreachable_pub)]

pub mod photos;
pub mod surfaces;

/// A PNG of these rows of samples.
pub fn png(width: usize, height: usize, color: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    drop(writer);
    bytes
}

/// An 8-bit grey PNG of `grey(x, y)`, 0 to 1.
pub fn grey_png(width: usize, height: usize, grey: impl Fn(usize, usize) -> f64) -> Vec<u8> {
    png(width, height, png::ColorType::Grayscale, png::BitDepth::Eight, &grey_bytes(width, height, grey))
}

/// The negative of an 8-bit grey PNG.
pub fn negative_png(bytes: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut data).unwrap();
    data.iter_mut().for_each(|v| *v = 255 - *v);
    png(info.width as usize, info.height as usize, info.color_type, info.bit_depth, &data)
}

pub fn grey_bytes(width: usize, height: usize, grey: impl Fn(usize, usize) -> f64) -> Vec<u8> {
    let pixels = (0..width * height).map(|i| (255.0 * grey(i % width, i / width)).round() as u8);
    pixels.collect()
}

/// An NPY file, version 1, of raw items.
pub fn npy(descr: &str, fortran: bool, shape: [usize; 2], data: &[u8]) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let mut header =
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({}, {}), }}", shape[0], shape[1]);
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\0".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

pub fn npy_f8(rows: usize, columns: usize, value: impl Fn(usize, usize) -> f64) -> Vec<u8> {
    let data: Vec<u8> = (0..rows * columns).flat_map(|i| value(i / columns, i % columns).to_le_bytes()).collect();
    npy("<f8", false, [rows, columns], &data)
}

/// The share of a pixel's 16 x 16 sub-points that `inside` holds.
pub fn cover(x: usize, y: usize, inside: impl Fn(f64, f64) -> bool) -> f64 {
    let at = |i: usize, k: usize| i as f64 + (k as f64 + 0.5) / 16.0;
    let hits = (0..256).filter(|k| inside(at(x, k % 16), at(y, k / 16))).count();
    hits as f64 / 256.0
}

/// Marsaglia's xorshift.
pub struct Noise(pub u64);

impl Noise {
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() >> 16) as usize % n.max(1)
    }

    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Roughly normal, standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Total length along z of the damage at `s`, from polygons by the even-odd rule.
pub fn width_at(polygons: &[Vec<[f64; 2]>], s: f64) -> f64 {
    let mut cuts = Vec::new();
    for ring in polygons {
        for (i, a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            if (a[0] <= s) != (b[0] <= s) {
                cuts.push(a[1] + (s - a[0]) / (b[0] - a[0]) * (b[1] - a[1]));
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    cuts.chunks_exact(2).map(|pair| pair[1] - pair[0]).sum()
}

/// Whether a point is damaged, by the even-odd rule.
pub fn holds(polygons: &[Vec<[f64; 2]>], [s, z]: [f64; 2]) -> bool {
    let mut inside = false;
    for ring in polygons {
        for (i, a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            if (a[0] <= s) != (b[0] <= s) && z < a[1] + (s - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) {
                inside = !inside;
            }
        }
    }
    inside
}

/// The most memory that this process has held, MB (Linux).
pub fn peak_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kb = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    kb.unwrap_or(0.0) / 1024.0
}
