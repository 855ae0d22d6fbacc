//! Gaussian blur of a picture: what keeps grain and JPEG blocks from becoming damage.

use crate::pixels::Pixels;

/// Blurs with the standard deviation `sigma` in pixels, cut at three of them; the border repeats outwards.
pub(crate) fn gaussian(pixels: &mut Pixels, sigma: f64) {
    let reach = (3.0 * sigma).ceil() as usize;
    if reach == 0 {
        return;
    }
    let (width, height) = (pixels.width, pixels.height);
    let mut kernel: Vec<f32> = (0..=2 * reach)
        .map(|i| {
            let x = (i as f64 - reach as f64) / sigma;
            (-0.5 * x * x).exp() as f32
        })
        .collect();
    let sum: f32 = kernel.iter().sum();
    kernel.iter_mut().for_each(|k| *k /= sum);

    let mut padded = vec![0.0_f32; width + 2 * reach];
    for row in pixels.values.chunks_exact_mut(width) {
        for (i, value) in padded.iter_mut().enumerate() {
            *value = f32::from(row[i.saturating_sub(reach).min(width - 1)]);
        }
        for (x, value) in row.iter_mut().enumerate() {
            let window = &padded[x..=x + 2 * reach];
            let sum: f32 = window.iter().zip(&kernel).map(|(v, k)| v * k).sum();
            *value = sum.round() as u16;
        }
    }
    // In place: a second picture would double the memory. The rows above that are still needed are kept as they were,
    // row y in place y mod reach + 1.
    let mut above = vec![0; (reach + 1) * width];
    let kept = |y: usize| (y % (reach + 1)) * width..(y % (reach + 1) + 1) * width;
    let mut sums = vec![0.0_f32; width];
    for y in 0..height {
        above[kept(y)].copy_from_slice(&pixels.values[y * width..(y + 1) * width]);
        sums.fill(0.0);
        for (i, &k) in kernel.iter().enumerate() {
            let from = (y + i).saturating_sub(reach).min(height - 1);
            let row = match from <= y {
                true => &above[kept(from)],
                false => &pixels.values[from * width..(from + 1) * width],
            };
            for (sum, &value) in sums.iter_mut().zip(row) {
                *sum += k * f32::from(value);
            }
        }
        let row = &mut pixels.values[y * width..(y + 1) * width];
        for (value, sum) in row.iter_mut().zip(&sums) {
            *value = sum.round() as u16;
        }
    }
}
