/** Micrometres in a metre; positions are packed in micrometres. */
export const MICRO = 1e-6;
