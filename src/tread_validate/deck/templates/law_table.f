c
c     Kinetic friction coefficient from a table, linear in log p and
c     log v, end values held outside it.
c     props(1)  static coefficient
c     props(2)  number of contact pressures, np
c     props(3)  number of slip speeds, nv
c     then np contact pressures (MPa) and nv slip speeds (mm/s), both
c     increasing, and np rows of nv coefficients, one row a pressure
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      np = nint(props(2))
      nv = nint(props(3))
      call fricel(np, props(4), abs(press), i, fi)
      call fricel(nv, props(4 + np), abs(speed), j, fj)
      k = 3 + np + nv + (i - 1)*nv + j
      below = props(k)*(1.d0 - fj) + props(k + 1)*fj
      above = props(k + nv)*(1.d0 - fj) + props(k + nv + 1)*fj
      fricmu = below*(1.d0 - fi) + above*fi
      return
      end
c
c     Cell of an increasing grid that holds a value, and the place in
c     it, 0 to 1, in the logarithm
c
      subroutine fricel(n, grid, value, i, f)
      include 'vaba_param.inc'
      dimension grid(n)
      if (value .le. grid(1)) then
         i = 1
         f = 0.d0
      else if (value .ge. grid(n)) then
         i = n - 1
         f = 1.d0
      else
         i = 1
   10    if (value .gt. grid(i+1)) then
            i = i + 1
            goto 10
         end if
         f = log(value/grid(i))/log(grid(i+1)/grid(i))
      end if
      return
      end
