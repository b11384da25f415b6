"""placeholder"""
def html(outcome, study): return ""
