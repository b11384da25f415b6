/** Micrometers in a meter; positions are packed in micrometers. */
export const MICRO = 1e-6;
