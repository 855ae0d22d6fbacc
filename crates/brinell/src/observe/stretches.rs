//! What is gathered of a signal of any length in a bounded number of stretches: full, they are joined two by two.

/// Rows of values, one a stretch of time; all stretches are equally long.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stretches<T> {
    pub(super) values: Vec<T>,
    /// Values of a stretch.
    width: usize,
    /// Stretches, at most; even.
    most: usize,
    /// Samples of a full stretch.
    pub(super) samples: u64,
    /// Those of the last one; 0 where it is full.
    pub(super) begun: u64,
}

impl<T: Copy> Stretches<T> {
    pub(super) fn new(most: usize, width: usize) -> Self {
        Self { values: Vec::with_capacity(most * width), width, most, samples: 1, begun: 0 }
    }

    /// The stretch that the next sample belongs to; a new one begins `blank`.
    #[inline]
    pub(super) fn next(&mut self, blank: T, join: impl Fn(T, T) -> T) -> &mut [T] {
        if self.begun == 0 {
            if self.values.len() == self.most * self.width {
                for k in 0..self.most / 2 * self.width {
                    let first = 2 * k - k % self.width;
                    self.values[k] = join(self.values[first], self.values[first + self.width]);
                }
                self.values.truncate(self.most / 2 * self.width);
                self.samples *= 2;
            }
            self.values.resize(self.values.len() + self.width, blank);
        }
        self.begun = (self.begun + 1) % self.samples;
        let first = self.values.len() - self.width;
        &mut self.values[first..]
    }
}
